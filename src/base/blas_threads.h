// The threads of the BLAS, which are beside ours: OpenBLAS shares out products of a few thousand numbers already, and
// its threads wait for each other by taking a processor. Inside work that our threads share they cost more than they
// give.
#pragma once

namespace dynalin {

// While one lives, the BLAS works in the thread that calls it. Of a BLAS other than OpenBLAS nothing is asked.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

}  // namespace dynalin
