#include "output/descriptor_files.h"

#include <fmt/ostream.h>
#include <matio.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "output/matrices.h"
#include "output/temporary_file.h"

namespace dynalin {

namespace {

std::string name_of(const StateLabel& s) {
  const std::string text = s.owner.empty() ? s.text : s.text + " " + s.owner.text();
  return s.is_rate ? "derivative of " + text : text;
}

struct Close {
  void operator()(mat_t* file) const { Mat_Close(file); }
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, Close>;

// Variables of one file; the first failure is remembered.
class MatFile {
 public:
  explicit MatFile(const char* path)
      : file_(Mat_CreateVer(path, "MATLAB 5.0 MAT-file, written by Dynalin", MAT_FT_MAT5)), ok_(file_ != nullptr) {}
  bool ok() const { return ok_; }

  void add(const char* name, const Eigen::SparseMatrix<double>& m) {
    std::vector<mat_uint32_t> rows(static_cast<std::size_t>(m.nonZeros())), starts;
    std::vector<double> values(m.valuePtr(), m.valuePtr() + m.nonZeros());
    for (Eigen::Index k = 0; k < m.nonZeros(); ++k)
      rows[static_cast<std::size_t>(k)] = static_cast<mat_uint32_t>(m.innerIndexPtr()[k]);
    for (Eigen::Index k = 0; k <= m.cols(); ++k) starts.push_back(static_cast<mat_uint32_t>(m.outerIndexPtr()[k]));
    const auto entries = static_cast<mat_uint32_t>(values.size());
    mat_sparse_t sparse{entries, rows.data(),  entries, starts.data(), static_cast<mat_uint32_t>(starts.size()),
                        entries, values.data()};
    add(name, MAT_C_SPARSE, MAT_T_DOUBLE, m.rows(), m.cols(), &sparse, MAT_F_DONT_COPY_DATA);
  }
  void add(const char* name, const Eigen::MatrixXd& m) {
    add(name, MAT_C_DOUBLE, MAT_T_DOUBLE, m.rows(), m.cols(), const_cast<double*>(m.data()), MAT_F_DONT_COPY_DATA);
  }
  void add(const char* name, const std::vector<std::string>& list) {
    std::vector<matvar_t*> cells;  // the list has them from here on
    for (const std::string& text : list)
      cells.push_back(variable(nullptr, MAT_C_CHAR, MAT_T_UINT8, 1, static_cast<Eigen::Index>(text.size()),
                               const_cast<char*>(text.data()), 0)
                          .release());
    add(name, MAT_C_CELL, MAT_T_CELL, static_cast<Eigen::Index>(cells.size()), 1, cells.data(), 0);
  }

 private:
  static Variable variable(const char* name, matio_classes kind, matio_types type, Eigen::Index rows,
                           Eigen::Index columns, void* data, int options) {
    std::size_t size[2] = {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns)};
    return Variable(Mat_VarCreate(name, kind, type, 2, size, data, options));
  }
  void add(const char* name, matio_classes kind, matio_types type, Eigen::Index rows, Eigen::Index columns, void* data,
           int options) {
    const Variable made = variable(name, kind, type, rows, columns, data, options);
    ok_ = ok_ && made && Mat_VarWrite(file_.get(), made.get(), MAT_COMPRESSION_NONE) == 0;
  }

  std::unique_ptr<mat_t, Close> file_;
  bool ok_;
};

std::vector<std::string> names_of(const std::vector<ChannelLabel>& channels) {
  std::vector<std::string> names;
  for (const ChannelLabel& c : channels) names.push_back(c.text);
  return names;
}

bool wrote_mat_file(const char* path, const DescriptorForm& form) {
  MatFile file(path);
  if (!file.ok()) return false;
  file.add("E", form.E);
  file.add("A", form.A);
  if (form.pinput) file.add("B", form.B);
  if (form.poutput) file.add("C", form.C);
  if (form.pinput && form.poutput) file.add("D", Eigen::MatrixXd(form.D));
  StateSpace lists;
  lists.states = form.states, lists.inputs = form.inputs, lists.outputs = form.outputs;
  lists.pinput = form.pinput, lists.poutput = form.poutput;
  for (const NamedMatrix& m : named_matrices(lists)) {
    if (m.name.size() > 1)
      file.add(m.name.c_str(), m.transposed_in_matlab ? Eigen::MatrixXd(m.value.transpose()) : m.value);
  }
  file.add("first_state", Eigen::MatrixXd::Constant(1, 1, static_cast<double>(form.first_state + 1)));
  std::vector<std::string> states;
  for (const StateLabel& s : form.states) states.push_back(name_of(s));
  file.add("states", states);
  if (form.pinput) file.add("inputs", names_of(form.inputs));
  if (form.poutput) file.add("outputs", names_of(form.outputs));
  return file.ok();
}

}  // namespace

void write_matrix_market(std::ostream& out, const Eigen::SparseMatrix<double>& m, const std::string& comment) {
  fmt::print(out, "%%MatrixMarket matrix coordinate real general\n% {}\n{} {} {}\n", comment, m.rows(), m.cols(),
             m.nonZeros());
  // Streams are slow line by line.
  fmt::memory_buffer lines;
  for (Eigen::Index c = 0; c < m.outerSize(); ++c) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(m, c); entry; ++entry)
      fmt::format_to(std::back_inserter(lines), "{} {} {}\n", entry.row() + 1, entry.col() + 1, entry.value());
    if (lines.size() > 60000 || c + 1 == m.outerSize()) {
      out.write(lines.data(), static_cast<std::streamsize>(lines.size()));
      lines.clear();
    }
  }
}

// The library that knows the format writes to files alone.
void write_mat_file(std::ostream& out, const DescriptorForm& form) {
  auto file = TemporaryFile::create(std::filesystem::temp_directory_path().string());
  if (!file || !wrote_mat_file(file->path(), form)) return out.setstate(std::ios::badbit);
  std::ifstream written(file->path(), std::ios::binary);
  out << written.rdbuf();
}

void write_labels(std::ostream& out, const DescriptorForm& form) {
  fmt::print(out, "kind\tnumber\tunknown\ttype\telement\tcoordinate\tname\n");
  for (std::size_t k = 0; k < form.states.size(); ++k) {
    const StateLabel& s = form.states[k];
    fmt::print(out, "state\t{}\t{}\t{}\t{}\t{}\t{}\n", k + 1, form.first_state + 1 + static_cast<Eigen::Index>(k),
               static_cast<int>(s.type), s.element, s.coordinate, name_of(s));
  }
  const auto channels = [&](std::string_view kind, const std::vector<ChannelLabel>& list) {
    for (std::size_t k = 0; k < list.size(); ++k)
      fmt::print(out, "{}\t{}\t\t\t{}\t\t{}\n", kind, k + 1, list[k].variable, list[k].text);
  };
  channels("input", form.inputs);
  channels("output", form.outputs);
}

}  // namespace dynalin
