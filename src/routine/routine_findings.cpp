#include "routine/routine_findings.h"

namespace dynalin {

namespace {
thread_local RoutineFindings* findings_now = nullptr;
}

void RoutineFindings::add(const RoutineFindings& more) {
  differenced = differenced || more.differenced;
  kinks.insert(more.kinks.begin(), more.kinks.end());
  wrong_partials.insert(more.wrong_partials.begin(), more.wrong_partials.end());
}

RoutineFindings* RoutineFindings::current() { return findings_now; }

RoutineFindings::Scope::Scope(RoutineFindings& findings) : before_(findings_now) { findings_now = &findings; }
RoutineFindings::Scope::~Scope() { findings_now = before_; }

}  // namespace dynalin
