// What the program can be asked to do: each has its options, where they are kept, and what is done with them.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "command/session.h"
#include "nastran_reader/nastran_program.h"
#include "reduction/reduce_program.h"

class Subcommand {
 public:
  Subcommand(CLI::App& of, const std::string& name, const std::string& help) : app_(*of.add_subcommand(name, help)) {}
  virtual ~Subcommand() = default;
  Subcommand(const Subcommand&) = delete;
  Subcommand& operator=(const Subcommand&) = delete;

  bool was_chosen() const { return app_.parsed(); }
  // The exit status.
  virtual int run() = 0;

 protected:
  CLI::App& app_;
};

class RunSubcommand final : public Subcommand {
 public:
  RunSubcommand(CLI::App&, dynalin::SessionOptions&);
  int run() override;

 private:
  dynalin::SessionOptions& options_;
  std::size_t threads_;
};

class CheckSubcommand final : public Subcommand {
 public:
  CheckSubcommand(CLI::App&, dynalin::SessionOptions&);
  int run() override;

 private:
  dynalin::SessionOptions& options_;
};

class NastranSubcommand final : public Subcommand {
 public:
  explicit NastranSubcommand(CLI::App&);
  int run() override;

 private:
  dynalin::nastran_reader::SolveOptions deck_;
  CLI::App &check_, &solve_;
};

class ReduceSubcommand final : public Subcommand {
 public:
  explicit ReduceSubcommand(CLI::App&);
  int run() override;
  std::string help() const { return app_.help(); }

 private:
  dynalin::reduction::ReduceOptions body_;
};

class HelpSubcommand final : public Subcommand {
 public:
  HelpSubcommand(CLI::App&, const ReduceSubcommand&);
  int run() override;

 private:
  const ReduceSubcommand& reduce_;
  std::vector<std::string> words_;
};

class ExplainSubcommand final : public Subcommand {
 public:
  explicit ExplainSubcommand(CLI::App&);
  int run() override;

 private:
  std::vector<std::string> words_;
};

// Commands on standard input instead of a file; false, said on standard error, if it cannot be read.
bool take_commands(dynalin::SessionOptions&);
