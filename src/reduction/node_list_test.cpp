// Places of nodes in input decks: keywords over several lines, and what moves nodes.
#include "reduction/node_list.h"

#include <gmock/gmock.h>

namespace dynalin::reduction::node_list_test {
namespace {

using ::testing::HasSubstr;

struct Read {
  std::optional<NodeList> list;
  std::string said;
};
Read read(const std::string& text) {
  const SourceText file("body.inp", text);
  Diagnostics diagnostics;
  Read r;
  r.list = read_nodes(file, diagnostics);
  r.said = render(diagnostics);
  return r;
}
const std::string nodes = "1, 0.5, 0.25\n1001, 0.5, 0.25\n";

TEST(NodeList, joins_a_keyword_that_goes_on_behind_a_comma) {
  for (const std::string& deck : {"*NODE,\nNSET=A\n" + nodes + "*RIGID BODY, NSET=A, REF NODE=1,\nROT NODE=1001\n",
                                  "*Node,  \r\n  nset=A,\r\n** a comment\r\n  SYSTEM=R\r\n" + nodes +
                                      "*rigid body,\n nset=A,\n ref node=1, \n rot node = 1001\n",
                                  // A comma too much, and nodes at once.
                                  "*NODE,\n" + nodes + "*RIGID BODY, ROT NODE=1001, REF NODE=1,\n*STEP\n",
                                  // Parameters of others are no data.
                                  "*ELEMENT, TYPE=C3D8,\nELSET=E\n1, 2, 3\n*NODE\n" + nodes +
                                      "*RIGID BODY, NSET=A, REF NODE=1, ROT NODE=1001,"}) {
    const Read r = read(deck);
    ASSERT_TRUE(r.list) << deck << r.said;
    EXPECT_EQ(r.list->nodes.size(), 2u) << deck;
    EXPECT_EQ(r.list->nodes.at(1), Eigen::Vector3d(0.5, 0.25, 0)) << deck;
    ASSERT_EQ(r.list->rotation_nodes.size(), 1u) << deck;
    EXPECT_EQ(r.list->rotation_nodes[0].reference, 1);
    EXPECT_EQ(r.list->rotation_nodes[0].rotation, 1001);
  }
  const Read curved = read("*NODE,\nSYSTEM=C\n" + nodes);
  EXPECT_FALSE(curved.list);
  EXPECT_THAT(curved.said, HasSubstr("body.inp:1:1: error: nodes in another system are not read"));
}

TEST(NodeList, refuses_nodes_of_a_system_that_is_not_global) {
  const Read moved = read("*SYSTEM\n10.,0.,0.,11.,0.,0.,10.,1.,0.\n*NODE\n" + nodes);
  EXPECT_FALSE(moved.list);
  EXPECT_THAT(moved.said, HasSubstr("body.inp:2:1: error: nodes in another system are not read"));
  EXPECT_TRUE(read("*SYSTEM\n*NODE\n" + nodes).list);
  EXPECT_TRUE(read("*SYSTEM\n0., 0., 0.\n*NODE\n" + nodes).list);
  // Without data it goes back to global axes; so does the end of a part.
  EXPECT_TRUE(read("*SYSTEM\n10.,0.,0.\n*SYSTEM\n*NODE\n" + nodes).list);
  EXPECT_TRUE(read("*PART,NAME=A\n*SYSTEM\n10.,0.,0.\n*END PART\n*PART,NAME=B\n*NODE\n" + nodes).list);
}

TEST(NodeList, refuses_an_instance_that_is_moved) {
  const std::string part =
      "*PART, NAME=P\n*NODE\n" + nodes + "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I,\nPART=P\n";
  const std::string end = "*END INSTANCE\n*END ASSEMBLY\n";
  const Read moved = read(part + "5.,0.,0.\n" + end);
  EXPECT_FALSE(moved.list);
  EXPECT_THAT(moved.said, HasSubstr("body.inp:9:1: error: an instance that is moved or turned is not read"));
  EXPECT_FALSE(read(part + "0.,0.,0.\n0.,0.,0.,0.,0.,1.,90.\n" + end).list);
  EXPECT_TRUE(read(part + end).list);
  EXPECT_TRUE(read(part + "0.,0.,0.\n" + end).list);
}

}  // namespace
}  // namespace dynalin::reduction::node_list_test
