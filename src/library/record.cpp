#include "dynalin/record.h"

#include <sstream>

#include "library/inside.h"
#include "output/json.h"
#include "system/operating_state.h"
#include "system/request_values.h"

namespace dynalin::library {

struct Record::Inside {
  JsonResults json;
  Units units;
  bool failed = false;

  void check_units(const OperatingPoint& point) const {
    if (point.inside().point.system->model().units != units)
      refuse("the result is in other units than the model of the record");
  }
  [[noreturn]] static void refuse(std::string why) { fail(Failure{"record", std::move(why), {}}); }
  void warn(const std::string& command, const std::vector<Remark>& remarks) {
    for (const Remark& r : remarks) json.add_warning(command, r);
  }
  template <class Result>
  void add_linear(const std::string& command, const LinearModel& of, const Result& result) {
    check_units(of.operating_point());
    if (result.of_equations != of.inside().linear.linear.model.of_equations)
      refuse("the result is one of another linear model");
    warn(command, of.remarks());
    json.add(command, result);
    const Linearization& linear = of.inside().linear;
    json.add_point(operating_state(*linear.system, linear.point));
    json.add_requests(requests_at(*linear.system, linear.point).values);
  }
  template <class Result>
  void add_matrices(const std::string& command, const LinearModel& of, const Result& result) {
    add_linear(command, of, result);
    warn(command, of.remarks_of_matrices());
    warn(command, of.inside().remarks_of_whole());
  }
};

Record::Record(const Model& model) : inside_(std::make_unique<Inside>()) {
  inside_->units = model.units();
  inside_->warn("", model.remarks());
}
Record::Record(Record&&) noexcept = default;
Record& Record::operator=(Record&&) noexcept = default;
Record::~Record() = default;

void Record::add(const std::string& command, const OperatingPoint& point) {
  inside_->check_units(point);
  inside_->warn(command, point.remarks());
  if (point.is_static())
    inside_->json.add(command, point.static_result());
  else
    inside_->json.add(command, point.state());
  const StudyPoint& p = point.inside().point;
  inside_->json.add_requests(requests_at(*p.system, point.is_static() ? p.statics->at_rest : p.values).values);
}

void Record::add(const std::string& command, const Simulation& simulation) {
  inside_->check_units(simulation.point);
  inside_->warn(command, simulation.point.remarks());
  inside_->json.add(command, simulation.point.time(), simulation.history);
  inside_->json.add_point(simulation.point.is_static() ? simulation.point.static_result().at_rest
                                                       : simulation.point.state());
}

void Record::add(const std::string& command, const LinearModel& of, const StateSpace& result) {
  inside_->add_matrices(command, of, result);
}
void Record::add(const std::string& command, const LinearModel& of, const SecondOrder& result) {
  inside_->add_matrices(command, of, result);
}
void Record::add(const std::string& command, const LinearModel& of, const DescriptorForm& result) {
  inside_->add_matrices(command, of, result);
}
void Record::add(const std::string& command, const LinearModel& of, const Modes& result, const ModalTables& tables) {
  if (!tables.tables.empty() && tables.of_equations != result.of_equations)
    Inside::refuse("the tables are of modes of another linear model");
  inside_->add_linear<EigenSolution>(command, of, result);
  inside_->json.add_tables(tables.tables);
  inside_->warn(command, result.remarks);
  inside_->warn(command, tables.remarks);
}
void Record::add(const std::string& command, double time) { inside_->json.add_plain(command, time); }

void Record::add(const std::string& command, const Error& error) {
  inside_->failed = true;
  inside_->warn(command, error.remarks);
  const std::string message = error.problems.empty() ? error.what() : error.problems.front().message;
  inside_->json.add_failure(command, error.analysis.empty() ? message : error.analysis + ": " + message, error.details,
                            error.problems.empty() ? std::string_view() : error.problems.front().code);
}

std::string Record::to_json() const {
  inside_->json.finish(inside_->units, inside_->failed ? 2 : 0, {});
  std::ostringstream out;
  inside_->json.write(out);
  return out.str();
}

}  // namespace dynalin::library
