// Requests bound to a system: functions that are evaluated and that nothing depends on. They put no equations and
// change none, so that a model is the same with and without them. A request that cannot be evaluated is left out with a
// warning.
#pragma once

#include <deque>
#include <variant>
#include <vector>

#include "elements/requests/marker_request.h"
#include "elements/requests/request_source.h"
#include "mechanics/bound_expression.h"
#include "mechanics/kernel.h"

namespace dynalin {

// What it points to lives as long as the kernel.
struct WantedRequest {
  const RequestInfo* info;
  const ElementLabel* label;                 // of the statement
  const std::vector<Expression>* functions;  // of the components; not of markers
};

class RequestKernel : public Kernel, public RequestSource {
 public:
  RequestKernel(std::vector<WantedRequest> wanted, Layout& layout) : wanted_(std::move(wanted)), layout_(layout) {}
  void bind(Binder&) override;

  std::size_t count() const override { return bound_.size(); }
  const RequestInfo& info(std::size_t request) const override { return *bound_[request].info; }
  void evaluate(const Motion&, std::size_t request, std::vector<double>& values) const override;
  std::string undefined_value(const Motion&, std::size_t request) const override;

 protected:
  // More of them, where they are known only now.
  virtual std::vector<WantedRequest> found(const Signals&) { return {}; }
  const RequestInfo* keep(RequestInfo info) { return &kept_.emplace_back(std::move(info)); }
  void leave_out(const ElementLabel&, const std::string& what, const Diagnostic& why);

 private:
  using Functions = std::vector<BoundExpression>;
  struct Bound {
    const RequestInfo* info;
    const ElementLabel* label;
    std::variant<MarkerRequest, Functions> values;
  };
  void bind_markers(const WantedRequest&, const Signals&);
  void bind_functions(const WantedRequest&, Binder&);

  std::vector<WantedRequest> wanted_;
  Layout& layout_;
  std::deque<RequestInfo> kept_;
  std::vector<Bound> bound_;
};

}  // namespace dynalin
