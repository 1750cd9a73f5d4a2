// dynalin reduce from files to file: every format gives the same body, and what is wrong is told at its place.
#include "reduction/reduce_program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "reduction/test_models.h"

namespace dynalin::reduction::reduce_program_test {
namespace {

using ::testing::HasSubstr;

class Reduce : public ::testing::Test {
 protected:
  Reduce() : folder_(std::filesystem::temp_directory_path() / fmt::format("dynalin_reduce_{}", ::getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~Reduce() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  std::string read(const std::string& name) const {
    std::ifstream in(path(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }

  static std::string triangle(const SparseMatrix& m, bool lower) {
    std::string text;
    for (Eigen::Index c = 0; c < m.cols(); ++c) {
      for (SparseMatrix::InnerIterator it(m, c); it; ++it) {
        if (lower ? it.row() >= c : it.row() <= c)
          text += fmt::format("{} {} {:.17g}\n", it.row() + 1, c + 1, it.value());
      }
    }
    return text;
  }
  static std::string market(const SparseMatrix& m) {
    const std::string entries = triangle(m, true);
    return fmt::format("%%MatrixMarket matrix coordinate real symmetric\n% made in a test\n{} {} {}\n{}", m.rows(),
                       m.cols(), std::count(entries.begin(), entries.end(), '\n'), entries);
  }
  static std::string cards(const SparseMatrix& m, const std::vector<Freedom>& freedoms, const std::string& name) {
    std::string text = fmt::format("DMIG,{},0,6,2,0\n", name);
    for (Eigen::Index c = 0; c < m.cols(); ++c) {
      const Freedom& column = freedoms[static_cast<std::size_t>(c)];
      for (SparseMatrix::InnerIterator it(m, c); it; ++it) {
        if (it.row() < c || it.value() == 0) continue;
        const Freedom& row = freedoms[static_cast<std::size_t>(it.row())];
        std::string value = fmt::format("{:.9E}", it.value());
        value[value.find('E')] = 'D';
        text += fmt::format("{:<8}{:<16}{:<16}{:<16}{:<16}*\n{:<8}{:<16}{:<16}{:<16}\n", "DMIG*", name, column.node,
                            column.direction, "", "*", row.node, row.direction, value);
      }
    }
    return text;
  }
  static std::string node_lines(const FiniteElementModel& model) {
    std::string text = "# node x y z\n";
    for (const auto& [label, x] : model.nodes)
      text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", label, x[0], x[1], x[2]);
    return text;
  }
  static std::string freedom_lines(const FiniteElementModel& model) {
    std::string text;
    for (const Freedom& f : model.freedoms) text += fmt::format("{}.{}\n", f.node, f.direction);
    return text;
  }
  ReduceOptions calculix(const FiniteElementModel& model) const {
    file("job.dof", freedom_lines(model));
    ReduceOptions options;
    // In both files the same places, with their zeros.
    options.stiffness = file("job.sti", triangle(model.stiffness + 0.0 * model.mass, false));
    options.mass = file("job.mas", triangle(model.mass + 0.0 * model.stiffness, false));
    options.nodes = file("nodes.txt", node_lines(model));
    options.output = path("body.fem");
    options.interface = {"1", "5"};
    options.modes = 6;
    return options;
  }
  int run(const ReduceOptions& options) {
    out_.str(""), err_.str("");
    return reduce(options, out_, err_);
  }
  // The numbers of a record, without its comments.
  std::vector<double> record(const std::string& name, int number) const {
    std::istringstream in(read(name));
    std::vector<double> values;
    bool inside = false;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("** RECORD GROUP")) inside = std::stoi(line.substr(15)) == number;
      if (line.starts_with("**") || !inside) continue;
      std::istringstream words(line);
      for (double v = 0; words >> v;) values.push_back(v);
    }
    return values;
  }

  std::filesystem::path folder_;
  std::ostringstream out_, err_;
};

TEST_F(Reduce, formats_give_the_same_body) {
  const FiniteElementModel beam = test::beam(4, 0.8);
  ReduceOptions options = calculix(beam);
  ASSERT_EQ(run(options), 0) << err_.str();
  EXPECT_THAT(out_.str(), HasSubstr("12 constraint modes + 6 fixed-interface modes - 6 rigid motions = 12 modes"));
  const std::string first = read("body.fem");
  options.stiffness = file("K.mtx", market(beam.stiffness)), options.mass = file("M.mtx", market(beam.mass));
  options.freedoms = path("job.dof");
  ASSERT_EQ(run(options), 0) << err_.str();
  EXPECT_EQ(read("body.fem"), first);
  const std::vector<double> stiffness = record("body.fem", 10);
  options.stiffness = options.mass =
      file("body.pch", cards(beam.stiffness, beam.freedoms, "KAAX") + cards(beam.mass, beam.freedoms, "MAAX"));
  ASSERT_EQ(run(options), 0) << err_.str();
  const std::vector<double> punched = record("body.fem", 10);
  ASSERT_EQ(punched.size(), 144u);
  for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(punched[13 * k] / stiffness[13 * k], 1, 1e-5);  // ten digits
}

// A square one has both triangles, and not one of them alone.
TEST_F(Reduce, square_direct_matrices_are_stated_in_both_triangles) {
  const FiniteElementModel beam = test::beam(4, 0.8);
  ReduceOptions options = calculix(beam);
  const std::string mass = cards(beam.mass, beam.freedoms, "MAAX");
  std::string stiffness = cards(beam.stiffness, beam.freedoms, "KAAX");
  stiffness.replace(stiffness.find(",6,2"), 4, ",1,2");
  options.stiffness = options.mass = file("body.pch", stiffness + mass);
  EXPECT_EQ(run(options), 1);
  EXPECT_THAT(err_.str(), HasSubstr("KAAX, a square matrix, has"));
  EXPECT_THAT(err_.str(), HasSubstr("here and nothing in the other triangle"));
}

TEST_F(Reduce, a_direct_matrix_has_entries) {
  const FiniteElementModel beam = test::beam(4, 0.8);
  ReduceOptions options = calculix(beam);
  options.stiffness = file("body.pch", "DMIG    KAAX           0       6       2       0\n");
  options.mass = file("mass.pch", cards(beam.mass, beam.freedoms, "MAAX"));
  EXPECT_EQ(run(options), 1);
  EXPECT_THAT(err_.str(), HasSubstr("body.pch:1:9: error: KAAX has no entries"));
}

TEST_F(Reduce, says_that_a_body_held_by_its_matrices_is_free_in_a_mechanism) {
  FiniteElementModel beam = test::beam(4, 0.8);
  // Springs inside: the modes have motions of the whole in them, but are none.
  for (Eigen::Index k = 12; k < 18; ++k) beam.stiffness.coeffRef(k, k) *= 1.5;
  ASSERT_EQ(run(calculix(beam)), 0) << err_.str();
  EXPECT_THAT(out_.str(), HasSubstr("only 0 of 6 rigid motions strain nothing\na FLEX_BODY is free all the same"));
}

TEST_F(Reduce, writes_no_body_that_no_mechanism_takes) {
  FiniteElementModel beam = test::beam(4, 0.8);
  for (Eigen::Index k = 0; k < 6; ++k) beam.stiffness.coeffRef(k, k) *= 1.5;
  EXPECT_EQ(run(calculix(beam)), 1);
  EXPECT_THAT(err_.str(), HasSubstr("error: no FLEX_BODY would take the reduced body"));
  EXPECT_EQ(out_.str(), "");
  EXPECT_FALSE(std::filesystem::exists(path("body.fem")));
}

TEST_F(Reduce, lists_of_nodes_have_no_empty_items) {
  ReduceOptions options = calculix(test::beam(4, 0.8));
  for (const std::vector<std::string>& list :
       std::vector<std::vector<std::string>>{{"1,5"}, {"1,", "5"}, {"1", ",5"}, {"1, 5"}, {"1 5"}}) {
    options.interface = list;
    ASSERT_EQ(run(options), 0) << list[0] << err_.str();
    EXPECT_EQ(record("body.fem", 2), (std::vector<double>{1, 5}));
  }
  for (const char* const list : {"1,", ",1", "1,,5", ",", "1, ,5"}) {
    options.interface = {list};
    EXPECT_EQ(run(options), 3) << list;
    EXPECT_THAT(err_.str(), HasSubstr("error: --interface has an empty item"));
  }
  options.interface = {"1,5"}, options.also = {"3,"};
  EXPECT_EQ(run(options), 3);
  EXPECT_THAT(err_.str(), HasSubstr("error: --also has an empty item"));
}

TEST_F(Reduce, the_file_has_the_records_of_the_body) {
  const FiniteElementModel beam = test::beam(4, 0.8);
  ReduceOptions options = calculix(beam);
  options.also = {"3"};
  ASSERT_EQ(run(options), 0) << err_.str();
  EXPECT_THAT(read("body.fem"), HasSubstr("   REV0 3 12 0 0 0\n"));
  EXPECT_EQ(record("body.fem", 2), (std::vector<double>{1, 5, 3}));
  EXPECT_EQ(record("body.fem", 5), (std::vector<double>{0, 0.8, 0.4}));
  EXPECT_EQ(record("body.fem", 8).size(), 12u * 3u * 6u);
  const std::vector<double> whole = record("body.fem", 12), mass = record("body.fem", 9);
  ASSERT_EQ(whole.size(), 13u);
  EXPECT_NEAR(whole[0], test::Section().mass * 0.8, 1e-12);
  EXPECT_NEAR(whole[1], 0.4, 1e-12);
  EXPECT_EQ(mass[0], 1);
  EXPECT_EQ(mass[1], 0);
  // Nothing of the rigid motions is in the modes: no momentum, neither of translation nor about the origin.
  for (const double v : record("body.fem", 14)) EXPECT_NEAR(v, 0, 1e-9);
  for (const double v : record("body.fem", 15)) EXPECT_NEAR(v, 0, 1e-9);
  EXPECT_EQ(record("body.fem", 16).size(), 9u * 12u);
  EXPECT_EQ(record("body.fem", 17).size(), 3u * 144u);
  EXPECT_EQ(record("body.fem", 18).size(), 9u * 144u);
}

// With all shapes of a block and a deformation q, inertia by the invariants is that of the moved nodes.
TEST_F(Reduce, inertia_follows_the_deformation) {
  const FiniteElementModel block = test::bricks({.elements = {2, 1, 1}});
  ReduceOptions options = calculix(block);
  options.interface = {"1", "3", "4", "7"}, options.translations_only = true, options.modes = 100;
  for (const auto& [label, x] : block.nodes) options.also.push_back(std::to_string(label));
  ASSERT_EQ(run(options), 0) << err_.str();
  const std::vector<double> labels = record("body.fem", 2), shapes = record("body.fem", 8);
  const std::size_t n = labels.size(), N = shapes.size() / (6 * n);
  ASSERT_EQ(n, 12u);
  ASSERT_EQ(N, 30u);
  Eigen::VectorXd q(static_cast<Eigen::Index>(N));
  for (std::size_t j = 0; j < N; ++j) q[static_cast<Eigen::Index>(j)] = 1e-3 * static_cast<double>(j % 7) - 2e-3;
  FiniteElementModel moved = block;
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(block.mass.rows());
  for (std::size_t node = 0; node < n; ++node) {
    const auto label = static_cast<NodeLabel>(labels[node]);
    for (std::size_t d = 0; d < 3; ++d) {
      for (std::size_t j = 0; j < N; ++j) {
        const double u = shapes[(j * n + node) * 6 + d] * q[static_cast<Eigen::Index>(j)];
        moved.nodes[label][static_cast<Eigen::Index>(d)] += u;
        displacement[3 * (label - 1) + static_cast<Eigen::Index>(d)] += u;
      }
    }
  }
  const auto about_origin = [](const FiniteElementModel& model) {
    Eigen::MatrixXd turns = Eigen::MatrixXd::Zero(model.mass.rows(), 3);
    for (Eigen::Index row = 0; row < turns.rows(); ++row) {
      const Freedom& f = model.freedoms[static_cast<std::size_t>(row)];
      turns.row(row) = model.nodes.at(f.node).cross(Eigen::Vector3d::Unit(f.direction - 1)).transpose();
    }
    return Eigen::Matrix3d(turns.transpose() * model.mass * turns);
  };
  Eigen::Matrix3d J = about_origin(block);
  const std::vector<double> r16 = record("body.fem", 16), r17 = record("body.fem", 17), r18 = record("body.fem", 18);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t j = 0; j < N; ++j) {
      const auto at = static_cast<Eigen::Index>(row);
      const double qj = q[static_cast<Eigen::Index>(j)];
      for (std::size_t c = 0; c < 3; ++c) {
        const double v = r16[(row * N + j) * 3 + c] * qj;
        J(at, static_cast<Eigen::Index>(c)) += v, J(static_cast<Eigen::Index>(c), at) += v;
        for (std::size_t k = 0; k < N; ++k)
          J(at, static_cast<Eigen::Index>(c)) -=
              r18[((row * N + j) * N + k) * 3 + c] * qj * q[static_cast<Eigen::Index>(k)];
      }
    }
  }
  EXPECT_LT((J - about_origin(moved)).cwiseAbs().maxCoeff(), 1e-12 * J.norm());
  EXPECT_GT((J - about_origin(block)).cwiseAbs().maxCoeff(), 1e-6 * J.norm());
  // Σ m u × φ_k for the displacement u, against the same sum over the mass matrix.
  for (std::size_t k = 0; k < N; ++k) {
    Eigen::VectorXd shape = Eigen::VectorXd::Zero(displacement.size());
    for (std::size_t node = 0; node < n; ++node) {
      for (Eigen::Index d = 0; d < 3; ++d)
        shape[3 * (static_cast<NodeLabel>(labels[node]) - 1) + d] =
            shapes[(k * n + node) * 6 + static_cast<std::size_t>(d)];
    }
    const Eigen::VectorXd momentum = block.mass * shape;
    Eigen::Vector3d expected = Eigen::Vector3d::Zero(), found = expected;
    for (Eigen::Index node = 0; node < 12; ++node)
      expected += displacement.segment<3>(3 * node).cross(momentum.segment<3>(3 * node));
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t j = 0; j < N; ++j)
        found[static_cast<Eigen::Index>(row)] += r17[(row * N + j) * N + k] * q[static_cast<Eigen::Index>(j)];
    }
    EXPECT_LT((found - expected).norm(), 1e-12 * (1 + expected.norm())) << k;
  }
}

TEST_F(Reduce, a_rotation_node_turns_the_node_it_belongs_to) {
  FiniteElementModel beam = test::beam(4, 0.8);
  ReduceOptions options = calculix(beam);
  ASSERT_EQ(run(options), 0) << err_.str();
  const std::string first = read("body.fem");
  // Rotations of the ends become translations of nodes 101 and 105, as those of rigid bodies are in CalculiX.
  for (Freedom& f : beam.freedoms) {
    if ((f.node == 1 || f.node == 5) && f.direction > 3) f = {f.node + 100, f.direction - 3};
  }
  options = calculix(beam);
  options.interface = {"1:101", "5:105"};
  ASSERT_EQ(run(options), 0) << err_.str();
  EXPECT_EQ(read("body.fem"), first);
  options.interface = {"1", "5"};
  std::string deck = "*HEADING\n ends\n*Node, NSET=all\n";
  for (const auto& [label, x] : beam.nodes) deck += fmt::format("{}, {:.17g}, {:.17g}\n", label, x[0], x[1]);
  deck +=
      "*RIGID BODY, NSET=left, REF NODE=1, ROT NODE=101\n*Rigid body,nset=right,ref node=5,rot node=105\n*STEP\n1, 2\n";
  options.nodes = file("job.inp", deck);
  ASSERT_EQ(run(options), 0) << err_.str();
  EXPECT_EQ(read("body.fem"), first);
  std::filesystem::remove(path("body.fem"));
  options.interface = {"1:77", "5"};
  EXPECT_EQ(run(options), 1);
  EXPECT_THAT(err_.str(), HasSubstr("node 77, which is to turn node 1, has no freedoms"));
  // Both may say the same, but not different things.
  options.interface = {"1:101", "5"};
  ASSERT_EQ(run(options), 0) << err_.str();
  EXPECT_EQ(read("body.fem"), first);
  std::filesystem::remove(path("body.fem"));
  options.interface = {"1:105", "5"};
  EXPECT_EQ(run(options), 1);
  EXPECT_THAT(err_.str(), HasSubstr("node 105 and node 101 turn node 1"));
  options.interface = {"1", "2:105"};
  EXPECT_EQ(run(options), 1);
  EXPECT_THAT(err_.str(), HasSubstr("node 105 turns node 2 and node 5"));
  EXPECT_FALSE(std::filesystem::exists(path("body.fem")));
}

TEST_F(Reduce, factors_of_units_change_the_numbers_of_the_body) {
  ReduceOptions options = calculix(test::beam(4, 0.8));
  ASSERT_EQ(run(options), 0) << err_.str();
  const auto k = record("body.fem", 10), shapes = record("body.fem", 8), whole = record("body.fem", 12);
  options.length_factor = 1000;
  ASSERT_EQ(run(options), 0) << err_.str();
  EXPECT_NEAR(record("body.fem", 10)[0] / k[0], 1e-3, 1e-15);
  EXPECT_DOUBLE_EQ(record("body.fem", 8)[0], shapes[0]);
  EXPECT_DOUBLE_EQ(record("body.fem", 8)[4], shapes[4] / 1000);
  EXPECT_DOUBLE_EQ(record("body.fem", 12)[12], whole[12] * 1e6);
  const auto mass = record("body.fem", 9);
  const auto in_metres = record("body.fem", 12), stiffness = record("body.fem", 10);
  options.mass_factor = 1000;
  ASSERT_EQ(run(options), 0) << err_.str();
  EXPECT_THAT(out_.str(), HasSubstr("the body file is in others"));
  EXPECT_DOUBLE_EQ(record("body.fem", 9)[0], mass[0] * 1e3);
  EXPECT_EQ(record("body.fem", 10), stiffness);
  EXPECT_DOUBLE_EQ(record("body.fem", 12)[0], whole[0] * 1e3);
  EXPECT_DOUBLE_EQ(record("body.fem", 12)[1], in_metres[1]);
  EXPECT_DOUBLE_EQ(record("body.fem", 12)[12], in_metres[12] * 1e3);
}

TEST_F(Reduce, asks_about_places_that_do_not_fit_the_matrices) {
  FiniteElementModel beam = test::beam(4, 0.8);
  for (auto& [label, place] : beam.nodes) place *= 1000;
  EXPECT_EQ(run(calculix(beam)), 1);
  EXPECT_THAT(err_.str(), HasSubstr("strain nothing: are the places of the nodes in the lengths of the matrices"));
}

TEST_F(Reduce, takes_grids_in_the_basic_system_alone) {
  const FiniteElementModel beam = test::beam(4, 0.8);
  std::string grids;
  for (const auto& [label, place] : beam.nodes)
    grids += fmt::format("GRID,{},,{:.6f},{:.6f},{:.6f}\n", label, place[0], place[1], place[2]);
  ReduceOptions options = calculix(beam);
  options.nodes = path("mesh.bdf");
  file("mesh.bdf", "BEGIN BULK\n" + grids + "ENDDATA\n");
  EXPECT_EQ(run(options), 0) << err_.str();
  file("mesh.bdf", "BEGIN BULK\nGRDSET,,5\n" + grids + "ENDDATA\n");
  EXPECT_EQ(run(options), 1);
  EXPECT_THAT(err_.str(), HasSubstr("mesh.bdf:2:1: error: GRDSET, which may give GRIDs another system"));
  file("mesh.bdf", "BEGIN BULK\n" + grids + "GRID,9,5,0.,0.,0.\nCORD2R,5,,0.,0.,0.,0.,0.,1.\n,1.,0.,1.\nENDDATA\n");
  EXPECT_EQ(run(options), 1);
  EXPECT_THAT(err_.str(), HasSubstr("GRID 9 is stated in another system than the basic one"));
}

TEST_F(Reduce, says_where_diagonals_and_parts_of_a_model_are_wrong) {
  const auto refused = [&](const ReduceOptions& options) {
    EXPECT_EQ(run(options), 1);
    return err_.str();
  };
  FiniteElementModel beam = test::beam(4, 0.8);
  // Line 2 of a file that begins with a comment is that of row 1, and so on down the upper triangle.
  beam.mass.coeffRef(0, 0) = -1;
  EXPECT_THAT(refused(calculix(beam)),
              HasSubstr("job.mas:1:1: error: the mass of node 1, direction 1 is negative: -1"));
  beam = test::beam(4, 0.8);
  beam.stiffness.coeffRef(8, 8) = -7;
  ReduceOptions options = calculix(beam);
  const std::string text = read("job.sti");
  const auto line_of = [](const std::string& t, const std::string& begin) {
    return 1 + std::count(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(t.find("\n" + begin) + 1), '\n');
  };
  EXPECT_THAT(refused(options),
              HasSubstr(fmt::format("job.sti:{}:1: error: the stiffness of node 2, direction 3 is negative: -7",
                                    line_of(text, "9 9 "))));
  // The same from cards, and a row that nothing holds.
  const std::string punched = cards(beam.stiffness, beam.freedoms, "KAAX") + cards(beam.mass, beam.freedoms, "MAAX");
  options.stiffness = options.mass = file("body.pch", punched);
  EXPECT_THAT(refused(options), HasSubstr("body.pch:"));
  EXPECT_THAT(err_.str(), HasSubstr("error: the stiffness of node 2, direction 3 is negative: -7"));
  EXPECT_THAT(err_.str(), HasSubstr("-7.000000000D+00"));
  beam = test::beam(4, 0.8);
  for (Eigen::Index k = 0; k < 30; ++k) beam.stiffness.coeffRef(27, k) = beam.stiffness.coeffRef(k, 27) = 0;
  options = calculix(beam);
  EXPECT_THAT(refused(options), HasSubstr(fmt::format("job.sti:{}:1: error: the stiffness is not positive in the "
                                                      "shapes of the reduction: node 5, direction 4 has no stiffness",
                                                      line_of(read("job.sti"), "28 28 "))));
  options = calculix(test::beam(4, 0.8));
  options.interface = {"1"};
  options.translations_only = true;
  EXPECT_EQ(run(options), 0) << err_.str();
}

TEST_F(Reduce, says_where_the_input_is_wrong) {
  const FiniteElementModel beam = test::beam(4, 0.8);
  const auto refused = [&](const ReduceOptions& options) {
    EXPECT_EQ(run(options), 1);
    EXPECT_FALSE(std::filesystem::exists(path("body.fem")));
    return err_.str();
  };
  ReduceOptions options = calculix(beam);
  file("job.mas", "1 1 2.0\n1 x 3.0\n");
  EXPECT_THAT(refused(options), HasSubstr("job.mas:2:1: error: an entry is row, column and a finite value"));
  file("job.mas", "1 1 2.0\n31 31 3.0\n");
  EXPECT_THAT(refused(options), HasSubstr("job.mas:2:1: error: row 31, column 31 is outside the 30 freedoms"));
  file("job.mas", "1 1 2.0\n1 2 3.0\n2 1 3.0\n");
  EXPECT_THAT(refused(options),
              HasSubstr("job.mas:3:1: error: row 1, column 2 is given twice, perhaps once in each triangle"));
  file("job.mas", "%%MatrixMarket matrix coordinate real general\n30 30 3\n1 1 2\n1 2 3\n2 1 4\n");
  EXPECT_THAT(refused(options), HasSubstr("error: row 2, column 1 is 4, and row 1, column 2 is 3"));
  file("job.mas", "%%MatrixMarket matrix coordinate complex symmetric\n30 30 0\n");
  EXPECT_THAT(refused(options), HasSubstr("job.mas:1:34: error: a matrix of stiffness or mass is not 'complex'"));
  file("job.mas", "%%MatrixMarket matrix coordinate real symmetric\n29 29 1\n1 1 1\n");
  EXPECT_THAT(refused(options), HasSubstr("29 rows and 29 columns, and there are 30 freedoms"));
  file("job.mas", "%%MatrixMarket matrix coordinate real symmetric\n30 30 2\n1 1 1\n");
  EXPECT_THAT(refused(options), HasSubstr("promises 2 entries, and 1 is there"));
  for (const auto* const empty : {"", "%%MatrixMarket matrix coordinate real symmetric\n30 30 0\n"}) {
    file("job.mas", empty);
    EXPECT_THAT(refused(options), HasSubstr("job.mas:1:1: error: the matrix has no entries"));
  }
  file("job.mas", "%%MatrixMarket matrix coordinate real symmetric\n30 30 3\n1 1 1\n3 2 1\n4 5 1\n");
  EXPECT_THAT(refused(options), HasSubstr("job.mas:5:1: error: the entries before are those of the other triangle"));
  options = calculix(beam);
  std::string cut = read("job.mas");
  cut.resize(cut.rfind('\n', cut.size() / 2) + 1);
  file("job.mas", cut);
  EXPECT_THAT(refused(options), HasSubstr("job.mas has fewer or more entries than"));
  options = calculix(beam);
  std::swap(options.stiffness, options.mass);
  EXPECT_THAT(refused(options), HasSubstr("a translation of the body moves no mass"));
  options = calculix(beam);
  file("job.dof", "1.1\n1.7\n");
  EXPECT_THAT(refused(options), HasSubstr("job.dof:2:1: error: a line is the number of a node and its direction"));
  file("job.dof", "1.1\n1.1\n");
  EXPECT_THAT(refused(options), HasSubstr("job.dof:2:1: error: node 1, direction 1 is another row already"));
  options = calculix(beam);
  file("nodes.txt", "1 0 0 0\n2 0.2 0\n");
  EXPECT_THAT(refused(options), HasSubstr("nodes.txt:2:1: error: a node is its number and x, y, z"));
  file("nodes.txt", "1 0 0 0\n5 0.8 0 0\n");
  EXPECT_THAT(refused(options), HasSubstr("the place of node 2 is not in"));
  options = calculix(beam);
  options.interface = {"1", "6"};
  EXPECT_THAT(refused(options), HasSubstr("interface node 6 has no freedoms"));
  options.interface = {"one"};
  EXPECT_EQ(run(options), 3);
  options = calculix(beam);
  options.stiffness = path("none.sti");
  EXPECT_THAT(refused(options), HasSubstr("none.sti cannot be read"));
}

}  // namespace
}  // namespace dynalin::reduction::reduce_program_test
