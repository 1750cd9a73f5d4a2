#include "expression/formal_partials.h"

#include <gtest/gtest.h>

#include "expression/expression_test_support.h"

namespace dynalin::formal_partials_test {
namespace {

using Sum = FormalPartials::Sum;

// Partials by DIF1(1) of expressions that share their terms.
class Formal {
 public:
  Sum by_rate(const std::string& text) {
    texts_.push_back(std::make_unique<expression_test::ParsedText>(expression_test::parse(text)));
    const Expression& e = texts_.back()->expression;
    const auto sums = partials_.of(e);
    const auto atoms = e.atoms();
    for (std::size_t k = 0; k < atoms.size(); ++k) {
      if (atoms[k].function->reads == DataSource::state_rate && atoms[k].argument[0] == 1) return sums[k];
    }
    return {};
  }

 private:
  FormalPartials partials_;
  std::vector<std::unique_ptr<expression_test::ParsedText>> texts_;
};

const Sum number(double c) { return {{FormalPartials::one, c}}; }

TEST(FormalPartials, of_sums_with_numbers_are_numbers) {
  Formal f;
  EXPECT_EQ(f.by_rate("3*DIF1(1)-DIF1(2)+DIF(1)/7"), number(3));
  EXPECT_EQ(f.by_rate("-(2-DIF1(1)/4)*8+DIF1(1)"), number(3));
  EXPECT_EQ(f.by_rate("DIF1(1)-DIF1(1)"), Sum{});
  EXPECT_EQ(f.by_rate("0.1*DIF1(1)+0.2*DIF1(1)-0.3*DIF1(1)"), Sum{}) << "but for rounding";
  EXPECT_EQ(f.by_rate("0*DIF1(1)+DIF(1)"), Sum{});
  EXPECT_EQ(f.by_rate("DIF1(1)**1+5"), number(1));
}

TEST(FormalPartials, with_the_same_factor_are_the_same_in_all_expressions) {
  Formal f;
  const Sum once = f.by_rate("DIF1(1)*(2+SIN(DIF(1)))");
  ASSERT_EQ(once.size(), 1u);
  EXPECT_NE(once.begin()->first, FormalPartials::one);
  EXPECT_EQ(f.by_rate("DIF(2)+(SIN(DIF(1))+2)*(DIF1(2)+DIF1(1))"), once);
  Sum twice = once;
  twice.begin()->second = 2;
  EXPECT_EQ(f.by_rate("2*(DIF1(1)-3)*(2+SIN(DIF(1)))"), twice);
  EXPECT_NE(f.by_rate("DIF1(1)*(2+SIN(DIF(2)))"), once);
  EXPECT_EQ(f.by_rate("DIF1(1)*DIF(1)*DIF(2)"), f.by_rate("DIF(2)*(DIF1(1)*DIF(1))"));
}

TEST(FormalPartials, of_what_is_not_linear_have_terms_of_their_own) {
  Formal f;
  EXPECT_EQ(f.by_rate("DIF1(1)**2"), f.by_rate("DIF1(1)*DIF1(1)"));
  EXPECT_EQ(f.by_rate("SIN(DIF1(1)+DIF(1))"), f.by_rate("3+SIN(DIF(1)+DIF1(1))"));
  EXPECT_NE(f.by_rate("SIN(DIF1(1))"), f.by_rate("COS(DIF1(1))"));
  EXPECT_EQ(f.by_rate("1/(4*DIF1(1))").size(), 1u);
  const Sum branch = f.by_rate("IF(DIF(1): 0, DIF1(1), 2*DIF1(1))");
  EXPECT_EQ(branch.size(), 2u);
  EXPECT_EQ(f.by_rate("IF(DIF(1): 7, DIF1(1), 2*DIF1(1))-1"), branch);
}

}  // namespace
}  // namespace dynalin::formal_partials_test
