#include "flexible/modal_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "dataset/number.h"

namespace dynalin {

namespace {

using Index = Eigen::Index;

constexpr std::string_view header = "** RECORD GROUP ", end_mark = "** END OF FILE";
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

class TextReader {
 public:
  TextReader(const SourceText& file, Diagnostics& diagnostics) : file_(file), text_(file.text()), out_(diagnostics) {}

  std::optional<ModalText> read() {
    while (!failed_ && next_record()) read_record();
    if (failed_) return std::nullopt;
    for (const auto& [number, what] : {std::pair<std::size_t, std::string_view>{1, "the sizes of the body"},
                                       {2, "its nodes"},
                                       {5, "x of its nodes"},
                                       {6, "y of its nodes"},
                                       {7, "z of its nodes"},
                                       {8, "the shapes of its modes"},
                                       {9, "the generalized mass"},
                                       {10, "the generalized stiffness"}}) {
      if (found_.contains(number) || (number >= 8 && modes_ == 0)) continue;
      error(span(text_.size(), text_.size()), fmt::format("{} has no RECORD GROUP {}: {}", file_.name(), number, what));
      return std::nullopt;
    }
    return std::move(body_);
  }

 private:
  Span span(std::size_t from, std::size_t to) const {
    return {&file_, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to - from)};
  }
  void error(const Span& at, std::string message, std::string hint = {}) {
    if (!failed_) out_.error("body-file", at, std::move(message), std::move(hint));
    failed_ = true;
  }

  // --- lines ----------------------------------------------------------------------------------------
  std::size_t line_end(std::size_t from) const { return std::min(text_.find('\n', from), text_.size()); }
  bool at_line_start() const { return at_ == 0 || text_[at_ - 1] == '\n'; }
  void to_next_line() { at_ = std::min(line_end(at_) + 1, text_.size()); }
  std::string_view rest_of_line() const { return text_.substr(at_, line_end(at_) - at_); }

  // Moves to the number of the next record; lines on the way are comments, but numbers there are too many.
  bool next_record() {
    if (!at_line_start()) {
      look_for_surplus();
      to_next_line();
    }
    for (; at_ < text_.size() && !failed_; to_next_line()) {
      const std::string_view line = rest_of_line();
      if (line.starts_with(end_mark)) return false;
      if (line.starts_with(header)) return true;
      look_for_surplus();
    }
    return false;
  }
  void look_for_surplus() {
    if (record_ == 0) return;
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    std::size_t end = at_;
    while (end < text_.size() && !is_blank(text_[end])) ++end;
    if (end == at_ || !number_in(text_.substr(at_, end - at_))) return;
    error(span(at_, end), fmt::format("RECORD GROUP {} holds more numbers than {}", record_, expected_),
          fmt::format("RECORD GROUP 1 states {} nodes and {} modes", nodes_, modes_));
  }

  // --- words and numbers ----------------------------------------------------------------------------
  // The next word of the record; lines that begin with ** are comments, where one may stand.
  std::optional<Span> word() {
    while (at_ < text_.size()) {
      if (is_blank(text_[at_])) {
        ++at_;
      } else if (at_line_start() && text_.substr(at_).starts_with("**")) {
        if (rest_of_line().starts_with(header) || rest_of_line().starts_with(end_mark)) return std::nullopt;
        to_next_line();
      } else {
        const std::size_t from = at_;
        while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
        return span(from, at_);
      }
    }
    return std::nullopt;
  }
  static std::optional<double> number_in(std::string_view word) {
    const bool negative = word.starts_with('-');
    if (negative || word.starts_with('+')) word.remove_prefix(1);
    if (word.empty() || number_extent(word, ExponentLetter::e_or_d).length != word.size()) return std::nullopt;
    return negative ? -number_value(word) : number_value(word);
  }
  // The numbers of the record that is being read.
  double number() {
    if (failed_) return 0;
    const auto w = word();
    if (!w) {
      error(span(at_, at_), fmt::format("RECORD GROUP {} ends after {} of {}", record_, read_, expected_),
            fmt::format("RECORD GROUP 1 states {} nodes and {} modes", nodes_, modes_));
      return 0;
    }
    const auto value = number_in(w->text());
    if (!value || !std::isfinite(*value)) {
      error(*w, fmt::format("{} is no number: RECORD GROUP {} takes {}", w->text(), record_, expected_));
      return 0;
    }
    ++read_;
    last_ = *w;
    return *value;
  }
  void expect(std::string what) { expected_ = std::move(what), read_ = 0; }
  std::vector<double> numbers(std::size_t count, std::string what) {
    expect(std::move(what));
    std::vector<double> list;
    list.reserve(std::min(count, text_.size() / 2 + 1));  // a number takes two characters at least
    for (std::size_t k = 0; k < count && !failed_; ++k) list.push_back(number());
    return list;
  }
  Eigen::VectorXd vector() {
    const auto list = numbers(modes_, fmt::format("{} numbers", modes_));
    return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Index>(list.size()));
  }
  Eigen::MatrixXd square() {
    const auto n = static_cast<Index>(modes_);
    const auto list = numbers(modes_ * modes_, fmt::format("{} × {} numbers", modes_, modes_));
    if (failed_) return {};
    Eigen::MatrixXd m = Eigen::Map<const Eigen::MatrixXd>(list.data(), n, n);
    const Eigen::MatrixXd skew = m - m.transpose();
    for (Index c = 0; c < n; ++c) {
      for (Index r = 0; r < c; ++r) {
        if (std::abs(skew(r, c)) <= 1e-8 * std::sqrt(std::abs(m(r, r) * m(c, c))) ||
            std::abs(skew(r, c)) <= 1e-8 * m.cwiseAbs().maxCoeff())
          continue;
        error(body_.at[record_], fmt::format("RECORD GROUP {} is not symmetric: {:g} at {}, {} and {:g} at {}, {}",
                                             record_, m(r, c), r + 1, c + 1, m(c, r), c + 1, r + 1));
        return m;
      }
    }
    return 0.5 * (m + m.transpose());
  }

  // --- records --------------------------------------------------------------------------------------
  void read_record() {
    const std::size_t from = at_;
    at_ += header.size();
    std::size_t end = at_;
    while (end < text_.size() && text_[end] >= '0' && text_[end] <= '9') ++end;
    const std::string_view digits = text_.substr(at_, end - at_);
    const Span place = span(from, line_end(from));
    record_ = digits.empty() || digits.size() > 3 ? 0 : static_cast<std::size_t>(number_value(digits));
    if (record_ < 1 || record_ >= ModalText::records)
      return error(place, fmt::format("RECORD GROUP {} is not known", digits), "records are numbered from 1 to 18");
    if (!found_.insert(record_).second) return error(place, fmt::format("RECORD GROUP {} is given twice", record_));
    if (found_.size() == 1 && record_ != 1)
      return error(place, fmt::format("RECORD GROUP {} stands before RECORD GROUP 1, which has its size", record_));
    body_.at[record_] = place;
    to_next_line();
    switch (record_) {
      case 1:
        return read_sizes();
      case 2:
        return read_labels();
      case 3:
        body_.displacement = vector();
        return;
      case 4:
        body_.rate = vector();
        return;
      case 5:
      case 6:
      case 7:
        return read_positions(record_ - 5);
      case 8:
        return read_shapes();
      case 9:
        body_.mass = square();
        return;
      case 10:
        body_.stiffness = square();
        return;
      case 11:
        return read_lumped();
      case 12:
        return read_whole();
      case 13:
        body_.damping = square();
        return;
      case 14:
        return read_rows(body_.translation_sums, 3 * modes_);
      case 15:
        return read_rows(body_.turning_sums, 3 * modes_);
      case 16:
        return read_rows(body_.tensor_sums, 9 * modes_);
      case 17:
        read_rows(body_.turning_products, 3 * modes_ * modes_);
        return check_turning_products();
      case 18:
        read_rows(body_.tensor_products, 9 * modes_ * modes_);
        return check_tensor_products();
      default:
        error(place, "RECORD GROUP 19, stress stiffening, is not available",
              "take the record out: the body then has no geometric stiffness, or split it into several bodies");
    }
  }

  void read_sizes() {
    to_next_line();  // a comment
    expect("a word and 5 counts");
    if (!word()) return static_cast<void>(number());
    std::array<double, 5> count{};
    for (double& c : count) {
      const std::size_t before = at_;
      c = number();
      if (failed_) return;
      if (c < 0 || c != std::floor(c) || c > 1e9)
        return error(span(before, at_), fmt::format("{:g} is no count of nodes or modes", c));
    }
    nodes_ = static_cast<std::size_t>(count[0]);
    rejected_ = static_cast<std::size_t>(count[4]);
    const double modes = count[1] + count[2] + count[3] - count[4];
    if (nodes_ == 0) return error(body_.at[1], "RECORD GROUP 1 states no node");
    if (modes < 0)
      return error(body_.at[1],
                   fmt::format("RECORD GROUP 1 rejects {} of {} modes", rejected_, count[1] + count[2] + count[3]));
    modes_ = static_cast<std::size_t>(modes);
    // Every node and every mode takes characters of the file: nothing is set aside for more than that.
    if (nodes_ > text_.size() || modes_ > text_.size() || (modes_ > 0 && nodes_ > text_.size() / modes_))
      return error(body_.at[1], fmt::format("the file is too short for {} nodes and {} modes", nodes_, modes_));
    const auto n = static_cast<Index>(modes_);
    body_.displacement = body_.rate = Eigen::VectorXd::Zero(n);
    body_.position.resize(nodes_);
    body_.translation = body_.rotation = Eigen::MatrixXd::Zero(3 * static_cast<Index>(nodes_), n);
    body_.mass = body_.stiffness = Eigen::MatrixXd::Zero(n, n);
  }

  void read_labels() {
    expect(fmt::format("{} labels", nodes_));
    std::set<std::string, std::less<>> seen;
    for (std::size_t k = 0; k < nodes_; ++k) {
      const auto w = word();
      if (!w) return static_cast<void>(number());
      body_.labels.emplace_back(w->text());
      if (!seen.insert(body_.labels.back()).second) return error(*w, fmt::format("node {} is given twice", w->text()));
      ++read_;
    }
  }

  void read_positions(std::size_t axis) {
    const auto list = numbers(nodes_, fmt::format("{} numbers", nodes_));
    for (std::size_t k = 0; k < list.size(); ++k) body_.position[k][axis] = list[k];
  }

  void read_shapes() {
    const std::size_t blocks = rejected_ + modes_;
    for (std::size_t block = 0; block < blocks && !failed_; ++block) {
      if (!at_line_start()) to_next_line();
      skip_title();
      expect(fmt::format("{} × 6 numbers of shape {}", nodes_, block + 1));
      const bool kept = block >= rejected_;
      const auto column = static_cast<Index>(block - std::min(block, rejected_));
      for (std::size_t p = 0; p < nodes_ && !failed_; ++p) {
        for (std::size_t k = 0; k < 6; ++k) {
          const double x = number();
          const auto row = static_cast<Index>(3 * p + k % 3);
          if (kept && !failed_) (k < 3 ? body_.translation : body_.rotation)(row, column) = x;
        }
      }
    }
  }
  // The comment over a shape, which need not begin with **.
  void skip_title() {
    const std::string_view line = rest_of_line();
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line.starts_with("**")) return;
    const auto last = std::min(line.find_first_of(" \t\r", first), line.size());
    if (!number_in(line.substr(first, last - first))) to_next_line();
  }

  void read_lumped() {
    expect(fmt::format("{} × 6 numbers", nodes_));
    std::vector<std::array<double, 6>> lumped;
    for (std::size_t p = 0; p < nodes_ && !failed_; ++p) {
      auto& own = lumped.emplace_back();
      for (double& x : own) {
        x = number();
        if (x < 0) return error(last_, fmt::format("a node has no mass or inertia of {:g}", x));
      }
    }
    body_.lumped = std::move(lumped);
  }

  void read_whole() {
    const auto x = numbers(13, "13 numbers: mass, centre of mass, inertia");
    if (failed_) return;
    if (!(x[0] > 0)) return error(body_.at[12], fmt::format("RECORD GROUP 12 states a mass of {:g}", x[0]));
    for (const auto& [above, below] : {std::pair{5u, 7u}, {6u, 10u}, {9u, 11u}}) {
      if (std::abs(x[above] - x[below]) <= 1e-8 * std::max({std::abs(x[4]), std::abs(x[8]), std::abs(x[12])})) continue;
      return error(body_.at[12], fmt::format("the inertia of RECORD GROUP 12 is not symmetric: it has {:g} and {:g}",
                                             x[above], x[below]));
    }
    for (const std::size_t k : {4u, 8u, 12u}) {
      if (x[k] < 0) return error(body_.at[12], fmt::format("RECORD GROUP 12 states a moment of inertia of {:g}", x[k]));
    }
    body_.whole = {x[0], {x[1], x[2], x[3]}, {{x[4], x[7], x[10]}, {x[5], x[8], x[11]}, {x[6], x[9], x[12]}}};
  }

  void read_rows(std::optional<std::vector<double>>& rows, std::size_t count) {
    rows = numbers(count, fmt::format("{} numbers", count));
  }

  // I5 of a pair of modes is that of the exchanged pair with the opposite sign, as a product of vectors.
  void check_turning_products() {
    const auto entry = [&](std::size_t c, std::size_t j, std::size_t k) {
      return (*body_.turning_products)[(c * modes_ + j) * modes_ + k];
    };
    check_pairs(*body_.turning_products, 3, [&](std::size_t c, std::size_t j, std::size_t k) {
      return std::pair{entry(c, j, k), -entry(c, k, j)};
    });
  }
  // I9 of a pair of modes is that of the exchanged pair, transposed.
  void check_tensor_products() {
    const auto entry = [&](std::size_t r, std::size_t j, std::size_t k, std::size_t c) {
      return (*body_.tensor_products)[3 * ((r * modes_ + j) * modes_ + k) + c];
    };
    check_pairs(*body_.tensor_products, 9, [&](std::size_t rc, std::size_t j, std::size_t k) {
      return std::pair{entry(rc / 3, j, k, rc % 3), entry(rc % 3, k, j, rc / 3)};
    });
  }
  // entries(component, j, k) are to be equal for all pairs of modes. Where other programs come near to that, as for a
  // mass that does not weigh all directions alike, the mean is taken.
  template <class Entries>
  void check_pairs(const std::vector<double>& all, std::size_t components, const Entries& entries) {
    if (failed_ || all.empty()) return;
    constexpr double rounding_of_records = 1e-6, near = 1e-2;
    const double largest = std::abs(*std::ranges::max_element(all, {}, [](double v) { return std::abs(v); }));
    double most = 0;
    for (std::size_t j = 0; j < modes_; ++j) {
      for (std::size_t k = 0; k <= j; ++k) {
        for (std::size_t c = 0; c < components; ++c) {
          const auto [one, other] = entries(c, j, k);
          most = std::max(most, std::abs(one - other));
          if (std::abs(one - other) <= near * largest) continue;
          return error(body_.at[record_], fmt::format("RECORD GROUP {} is of no body: modes {} and {} have {:g} where "
                                                      "modes {} and {} call for {:g}",
                                                      record_, j + 1, k + 1, one, k + 1, j + 1, other));
        }
      }
    }
    if (most > rounding_of_records * largest) {
      out_.warning(
          "body-file-doubt", body_.at[record_],
          fmt::format("what RECORD GROUP {} has of two modes differs by {:.1e} of its largest entry from what it "
                      "has of them in the other order: the mean is taken",
                      record_, most / largest));
    }
  }

  const SourceText& file_;
  std::string_view text_;
  Diagnostics& out_;
  std::size_t at_ = 0;
  Span last_;  // number
  bool failed_ = false;
  ModalText body_;
  std::set<std::size_t> found_;
  std::size_t record_ = 0, nodes_ = 0, modes_ = 0, rejected_ = 0, read_ = 0;
  std::string expected_;
};

}  // namespace

std::optional<ModalText> read_modal_text(const SourceText& file, Diagnostics& diagnostics) {
  return TextReader(file, diagnostics).read();
}

}  // namespace dynalin
