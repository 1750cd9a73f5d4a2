#include "system/request_values.h"

namespace dynalin {

namespace {

template <class Use>
void for_each_source(const System& system, const Use& use) {
  const auto& sets = system.model().sets;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (sets[s]->size() == 0 || !sets[s]->active) continue;
    const ElementHandle first{static_cast<std::int32_t>(s), 0};
    if (const auto* source = dynamic_cast<const RequestSource*>(system.signals().element(first).kernel)) use(*source);
  }
}

}  // namespace

PointRequests requests_at(const System& system, const OperatingPoint& point) {
  PointRequests all;
  std::optional<Motion> motion;  // where there is any
  for_each_source(system, [&](const RequestSource& source) {
    for (std::size_t k = 0; k < source.count(); ++k) {
      if (!motion) motion = system.motion(point);
      const RequestInfo& info = source.info(k);
      RequestValues r{info.request, info.view_name, {}, {}};
      for (const RequestComponent& c : info.components()) r.components.push_back(c.called());
      source.evaluate(*motion, k, r.values);
      all.infos.push_back(&info), all.values.push_back(std::move(r));
    }
  });
  return all;
}

std::vector<UndefinedRequest> undefined_requests(const System& system, const OperatingPoint& point) {
  const Motion motion = system.motion(point);
  std::vector<UndefinedRequest> list;
  for_each_source(system, [&](const RequestSource& source) {
    for (std::size_t k = 0; k < source.count(); ++k) {
      if (std::string reason = source.undefined_value(motion, k); !reason.empty())
        list.push_back({source.info(k).request, std::move(reason)});
    }
  });
  return list;
}

}  // namespace dynalin
