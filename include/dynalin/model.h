// A mechanism as an Adams dataset states it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynalin/element_id.h"
#include "dynalin/error.h"
#include "dynalin/parameter.h"
#include "dynalin/statement.h"
#include "dynalin/units.h"

namespace dynalin {

// What is decided before a model is made.
struct ReadingOptions {
  bool pade_delays = false;  // a DELAY as (1 − τs/2)/(1 + τs/2) with a state of its own, else as e − τ e′
  std::optional<double> user_value{};  // what takes the place of compiled user routines; nothing: they are errors
  // Shared libraries whose routines are called (dynalin/user_routine.h), or folders with libraries that ROUTINE= names.
  // A program that links the library must export the utilities that such routines call; CMake targets that link
  // dynalin do.
  std::vector<std::string> user_libraries{};
  // Differences take the place of derivatives that a routine does not give, in linear models as well, where they are
  // errors else.
  bool difference_user_routines = false;
};

namespace library {

// Constant once it is made, so that copies share what they hold and any number of threads may use one.
class Model {
 public:
  // Reads an Adams dataset (.adm). Throws Error with every problem of the file.
  static Model read(const std::string& path, const ReadingOptions& = {});
  // The same from text; `name` stands for the file in messages, and its folder is where MATRIX and SPLINE files lie.
  static Model from_text(std::string dataset, std::string name = "dataset.adm", const ReadingOptions& = {});
  // The same from statements, which go through the same checks; messages show them written out, in a file "(built)".
  static Model build(const std::string& title, const std::vector<StatedElement>&, const ReadingOptions& = {});

  const std::string& title() const;
  const Units& units() const;
  // Every statement with an id, in the order of the dataset.
  std::vector<ElementId> elements() const;
  // Warnings of reading; of a model that came out of a change those that the one before did not have.
  const std::vector<Remark>& remarks() const;

  // The number that the dataset states for a parameter, "BUSHING/1 K[2]", or that holds because it does not. Throws
  // Error if there is no such parameter, or if what holds without it is no number.
  double value(const ParameterRef&) const;
  // The same mechanism with other numbers, which are stated where they were not; this one stays as it is. Throws Error
  // with everything that is wrong, also with what the numbers lead to.
  Model with(const ParameterRef& parameter, double value) const { return with({{parameter, value}}); }
  Model with(const std::vector<ParameterChange>&) const;
  // The same after commands that change a model, one a line as in a command file: ACTIVATE, DEACTIVATE, and NAME/id,
  // ARGUMENT=… to define arguments anew.
  Model edited(const std::string& commands) const;

  struct Inside;  // what the program itself works with
  const Inside& inside() const { return *inside_; }

 private:
  explicit Model(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}
  std::shared_ptr<const Inside> inside_;
};

}  // namespace library
}  // namespace dynalin
