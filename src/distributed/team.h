// The processes that one run is made of. The first does everything that a single one would do: it reads, assembles,
// decides and writes. The others serve: they wait for orders to take part in a call of MUMPS or a Krylov iteration, see
// no file and no terminal, and end with the first.
//
// A build without DYNALIN_DISTRIBUTED has teams of one alone (alone.cpp).
#pragma once

namespace dynalin {

class Team {
 public:
  // Joins those that mpirun has started.
  Team();
  // Without end(): all of them are ended at once.
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  bool leads() const;
  // Of all but the first: takes orders until the first ends; its exit status.
  int serve();
  // Of the first: lets the others end with this exit status, and returns it.
  int end(int status);

 private:
  bool ended_ = false;
};

}  // namespace dynalin
