#include "system/request_values.h"

#include "system/sources.h"

namespace dynalin {

PointRequests requests_at(const System& system, const OperatingPoint& point) {
  PointRequests all;
  std::optional<Motion> motion;  // where there is any
  for_each_source<RequestSource>(system, [&](const ElementSet&, const RequestSource& source) {
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
  for_each_source<RequestSource>(system, [&](const ElementSet&, const RequestSource& source) {
    for (std::size_t k = 0; k < source.count(); ++k) {
      if (std::string reason = source.undefined_value(motion, k); !reason.empty())
        list.push_back({source.info(k).request, std::move(reason)});
    }
  });
  return list;
}

}  // namespace dynalin
