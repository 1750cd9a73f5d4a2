#include "geometry/facet_file.h"

#include <bit>

#include "geometry/mesh_test_support.h"

namespace dynalin::facet_file_test {
namespace {

const std::vector<std::array<double, 3>> corner_points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<std::array<int, 3>> tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

std::string text_stl(bool inside_out = false) {
  std::string text = "solid corner\n";
  for (auto f : tetrahedron) {
    if (inside_out) std::swap(f[0], f[1]);
    text += "facet normal 0 0 0\n  outer loop\n";
    for (const int v : f) {
      text += "    vertex";
      for (const double x : corner_points[static_cast<std::size_t>(v)]) text += " " + std::to_string(x);
      text += "\n";
    }
    text += "  endloop\nendfacet\n";
  }
  return text + "endsolid corner\n";
}
void put(std::string& bytes, std::uint32_t value) {
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> 8 * k & 0xff);
}
std::string binary_stl() {
  std::string bytes = "solid in name only";
  bytes.resize(80, ' ');
  put(bytes, 4);
  for (const auto& f : tetrahedron) {
    for (int k = 0; k < 3; ++k) put(bytes, 0);
    for (const int v : f) {
      for (const double x : corner_points[static_cast<std::size_t>(v)])
        put(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

void expect_tetrahedron(const tl::expected<Facets, std::string>& f) {
  ASSERT_TRUE(f) << f.error();
  EXPECT_EQ(f->mesh.vertices.size(), 4u);
  EXPECT_EQ(f->mesh.triangles.size(), 4u);
  EXPECT_EQ(f->flat, 0u);
  expect_closed(f->mesh, 2);
  EXPECT_NEAR(volume_of(f->mesh), 1.0 / 6, 1e-12);
}
std::string error_of(std::string_view name, std::string_view bytes) {
  const auto f = read_facets(name, bytes);
  return f ? "" : f.error();
}

TEST(FacetFile, reads_stl_as_text_and_as_bytes) {
  expect_tetrahedron(read_facets("a.stl", text_stl()));
  expect_tetrahedron(read_facets("A.STL", text_stl(true)));
  expect_tetrahedron(read_facets("a.Stl", binary_stl()));
}

TEST(FacetFile, reads_wavefront_objects) {
  const std::string obj =
      "# a corner\nmtllib none.mtl\no corner\nv 0 0 0\nv 1 0 0 1.0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn 0 0 1\nusemtl steel\n"
      "f 1/1 3/1 2/1\nf 1//1 2//1 4//1\nf -3 -2 \\\n -1\r\nf 3/1/1 1/1/1 4/1/1\ns off\n";
  expect_tetrahedron(read_facets("a.obj", obj));
  const auto with_line = read_facets("a.obj", obj + "l 1 2 3\n");
  ASSERT_TRUE(with_line);
  EXPECT_EQ(with_line->mesh.segments.size(), 2u);
}

TEST(FacetFile, reads_shell_files_of_both_versions) {
  const std::string points = "0 0 0\n2 0 0\n0 2 0\n0 0 2\n", polygons = "3 1 3 2\n3 1 2 4\n3 2 3 4\n3 3 1 4\n";
  expect_tetrahedron(read_facets("a.shl", "4 4 0.5\n" + points + polygons));
  expect_tetrahedron(read_facets("a.shl", "Version: 2\n4 4 1 0.5\n" + points + polygons + "0 0 1\n"));
}

TEST(FacetFile, keeps_polygons_with_more_corners) {
  const auto cube = read_facets("a.shl",
                                "8 6 1.0\n-1 -1 1\n-1 1 1\n1 1 1\n1 -1 1\n-1 -1 -1\n-1 1 -1\n1 1 -1\n1 -1 -1\n"
                                "4 1 2 3 4\n4 5 6 2 1\n4 2 6 7 3\n4 3 7 8 4\n4 1 4 8 5\n4 8 7 6 5\n");
  ASSERT_TRUE(cube) << cube.error();
  EXPECT_EQ(cube->mesh.quads.size(), 6u);
  expect_closed(cube->mesh, 2);
  EXPECT_NEAR(volume_of(cube->mesh), 8, 1e-12);
}

TEST(FacetFile, takes_the_part_that_is_asked_for) {
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no lid\ng a b\nf 1 2 3\ng c\nf 1 2 4\no base\nf 2 3 4\nl 1 2\n";
  const auto part = [&](std::string_view element) { return *read_facets("a.obj", obj, element); };
  EXPECT_EQ(part("").mesh.triangles.size(), 3u);
  EXPECT_EQ(part("").named_all, true);
  EXPECT_EQ(part("SHELL_10").mesh.triangles.size(), 3u);
  EXPECT_EQ(part("b").mesh.triangles.size(), 1u);
  EXPECT_EQ(part("b").mesh.vertices.size(), 3u);
  EXPECT_EQ(part("lid").mesh.triangles.size(), 2u);
  EXPECT_EQ(part("base").mesh.segments.size(), 1u);
  EXPECT_FALSE(part("base").named_all);
  const std::string second =
      "solid second one\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid\n";
  EXPECT_EQ(read_facets("a.stl", text_stl() + second, "second one")->mesh.triangles.size(), 1u);
  EXPECT_EQ(read_facets("a.stl", text_stl() + second, "corner")->mesh.triangles.size(), 4u);
}

TEST(FacetFile, leaves_out_flat_facets_and_counts_them) {
  const auto f = read_facets("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 2\n");
  ASSERT_TRUE(f);
  EXPECT_EQ(f->flat, 2u);
  EXPECT_EQ(f->mesh.vertices.size(), 3u);
}

TEST(FacetFile, says_on_which_line_what_is_wrong) {
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nv 1 0\n"), "line 2: a vertex needs three numbers");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nv 1 0 \\\n 0\nv 0 1 0\nf 1 2 9\n"),
            "line 5: it refers to a vertex that does not exist");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nf 0 0 0\n"), "line 2: it refers to a vertex that does not exist");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nf 1 1\n"), "line 2: it has too few vertices");
  EXPECT_EQ(error_of("a.obj", "v 0 0 nan\n"), "line 1: a vertex needs three numbers");
  EXPECT_EQ(error_of("a.stl", "solid a\nfacet\nvertex 1 2 x\n"), "line 3: a vertex needs three numbers");
  EXPECT_EQ(error_of("a.stl", "solid a\nvertex 1 2 3\nendloop\n"), "line 3: a facet needs three vertices");
  EXPECT_EQ(error_of("a.stl", "solid a\nvertex 1 2 3\n"), "line 3: the file ends inside a facet");
  EXPECT_EQ(error_of("a.stl", "solid a\nfacets\n"), "line 2: facets is no word of STL");
  EXPECT_EQ(error_of("a.stl", binary_stl().substr(0, 200) + "x"),
            "binary STL of another length than its number of facets says");
  EXPECT_EQ(error_of("a.stl", "\x7f"), "neither a text that begins with solid nor binary STL");
  EXPECT_EQ(error_of("a.shl", "2 1\n0 0 0\n"), "line 2: a point needs three numbers");
  EXPECT_EQ(error_of("a.shl", "x 1 1\n"),
            "line 1: a shell file begins with its numbers of points and polygons and a factor");
  EXPECT_EQ(error_of("a.shl", "1 -1 1\n0 0 0\n"), error_of("a.shl", "x 1 1\n"));
  EXPECT_EQ(error_of("a.shl", "-1 1 1\n0 0 0\n"), error_of("a.shl", "x 1 1\n"));
  EXPECT_EQ(error_of("a.shl", "1 1 1E300\n1E300 0 0\n"), "line 2: a coordinate is too large");
  EXPECT_EQ(error_of("a.shl", "1 1 1\n0 0 0\n3 1 1 2\n"), "line 3: it refers to a point that does not exist");
  EXPECT_EQ(error_of("a.shl", "1 1 1\n0 0 0\nend"), "line 3: a polygon begins with the number of its corners");
  EXPECT_EQ(error_of("a.shl", "Version: 3\n"), "line 1: versions 1 and 2 of shell files are known");
  EXPECT_EQ(error_of("a.obj", "# nothing\n"), "it holds no facets");
  EXPECT_EQ(error_of("a.xmt_txt", "**ABCDEFG\n"), "its format is not known here");
}

TEST(FacetFile, knows_its_formats_by_the_ending) {
  EXPECT_TRUE(is_facet_file("dir.x/Link.STL"));
  for (const auto name : {"a.xmt_txt", "a.x_t", "a.step", "a.igs", "a", ""}) EXPECT_FALSE(is_facet_file(name)) << name;
}

}  // namespace
}  // namespace dynalin::facet_file_test
