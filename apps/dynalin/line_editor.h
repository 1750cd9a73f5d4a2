// Lines of a terminal with history and completion, by libedit.
#pragma once

#include <memory>

#include "command/prompt.h"

class LineEditor final : public dynalin::LineSource {
 public:
  LineEditor();
  ~LineEditor() override;
  std::optional<std::string> next(const std::string& prompt, const dynalin::Model*) override;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};
