// A mechanism as an Adams dataset states it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynalin/element_id.h"
#include "dynalin/error.h"
#include "dynalin/units.h"

namespace dynalin {

// What is decided before a model is made.
struct ReadingOptions {
  bool pade_delays = false;  // a DELAY as (1 − τs/2)/(1 + τs/2) with a state of its own, else as e − τ e′
  std::optional<double> user_value{};  // what takes the place of compiled user routines; nothing: they are errors
};

namespace library {

// Constant once it is made, so that copies share what they hold and any number of threads may use one.
class Model {
 public:
  // Reads an Adams dataset (.adm). Throws Error with every problem of the file.
  static Model read(const std::string& path, const ReadingOptions& = {});
  // The same from text; `name` stands for the file in messages, and its folder is where MATRIX and SPLINE files lie.
  static Model from_text(std::string dataset, std::string name = "dataset.adm", const ReadingOptions& = {});

  const std::string& title() const;
  const Units& units() const;
  // Every statement with an id, in the order of the dataset.
  std::vector<ElementId> elements() const;
  // Warnings of reading.
  const std::vector<Remark>& remarks() const;

  struct Inside;  // what the program itself works with
  const Inside& inside() const { return *inside_; }

 private:
  explicit Model(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}
  std::shared_ptr<const Inside> inside_;
};

}  // namespace library
}  // namespace dynalin
