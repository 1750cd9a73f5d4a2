// GEAR/id, JOINTS=id1, id2, CV=
//
// Two gears, each joined to one carrier by a joint, move alike at the pitch point: seen from the carrier both have
// the same velocity along z of the common-velocity marker CV, which is fixed on the carrier. With the origin r_k and
// axis z_k of the joint's marker on the carrier, a rotation q_k gives b_k q_k′ and a translation c_k p_k′,
//
//     b_k = (z_k × (r_CV − r_k)) · z_CV,      c_k = z_k · z_CV
//
// and a CYLINDRICAL joint both. b and c are constant, so that b_1 q_1 + c_1 p_1 − b_2 q_2 − c_2 p_2 = const, measured
// from the configuration of the dataset. Where the carrier holds I instead of J the displacement changes its sign.
#include <fmt/format.h>

#include "elements/families/joint_relation.h"
#include "elements/families/markers.h"

namespace dynalin {

namespace {

struct Gear {
  std::vector<JointRef> joints;
  MarkerId cv;

  static constexpr std::array<Argument<Gear>, 2> arguments = {{
      {.name = "JOINTS", .slot = &Gear::joints, .required = true, .help = "the joints of both gears to the carrier"},
      {.name = "CV",
       .slot = &Gear::cv,
       .required = true,
       .help = "marker on the carrier: its origin is the pitch point, its z axis the direction of tooth motion"},
  }};
};

class GearSet final : public TypedSet<Gear> {
 public:
  using TypedSet::TypedSet;

  void read(std::size_t k, ElementReader& reader) override {
    if (!read_arguments(elements[k], reader)) return;
    if (elements[k].joints.size() != 2) {
      reader.error("wrong-count", reader.at("JOINTS"),
                   fmt::format("{} needs two joints, here are {}", reader.label().text(), elements[k].joints.size()));
    } else if (elements[k].joints[0] == elements[k].joints[1]) {
      reader.error("same-joint-twice", reader.at("JOINTS"),
                   fmt::format("both gears of {} hang on one joint", reader.label().text()),
                   "JOINTS takes one for each gear");
    }
  }

  void finish(Model& model, Diagnostics& diagnostics) override {
    for (std::size_t k = 0; k < elements.size(); ++k) {
      if (!check_fixed(model, labels[k], elements[k].cv, "CV", diagnostics)) continue;
      JointRelation relation;
      for (std::size_t j = 0; j < 2; ++j) add_gear(model, k, j, relation, diagnostics);
      relation.constant = drawn_value(model, relation);
      relations_.push_back(std::move(relation));
    }
  }

  std::unique_ptr<Kernel> make_kernel(const Model&, Layout& layout) const override {
    return std::make_unique<JointRelationKernel>(relations_, labels, "b.q", layout);
  }

 private:
  void add_gear(const Model& model, std::size_t k, std::size_t j, JointRelation& relation, Diagnostics& diagnostics) {
    const Gear& gear = elements[k];
    const JointRef joint = gear.joints[j];
    const auto* joints = dynamic_cast<const JointSetBase*>(&model.set(joint));
    if (!joints) return;
    const std::string name = model.label(joint).full_text();
    if (!joints->rotates() && !joints->translates()) {
      joint_freedom(model, labels[k], joint, DrivenFreedom::only, diagnostics);
      return;
    }
    const auto index = static_cast<std::size_t>(joint.index);
    const MarkerId i = joints->marker_I(index), marker_j = joints->marker_J(index);
    const MarkerPlace& cv = model.marker(gear.cv).place;
    const bool carrier_holds_J = model.marker(marker_j).place.body == cv.body;
    if (!carrier_holds_J && model.marker(i).place.body != cv.body) {
      diagnostics.error("foreign-marker", labels[k].at,
                        fmt::format("neither marker of {} is on the carrier of {}, the body of {}", name,
                                    labels[k].full_text(), model.marker(gear.cv).label->full_text()));
      return;
    }
    // All on the carrier, so in its BCS.
    const MarkerPlace& own = model.marker(carrier_holds_J ? marker_j : i).place;
    const Vector z = own.R_BM[2], z_cv = cv.R_BM[2], arm = cv.p_BM - own.p_BM;
    const double sign = (carrier_holds_J ? 1.0 : -1.0) * (j == 0 ? 1.0 : -1.0);
    const double b = joints->rotates() ? dot(cross(z, arm), z_cv) : 0.0, c = joints->translates() ? dot(z, z_cv) : 0.0;
    if (std::abs(b) <= 1e-6 * norm(arm) && std::abs(c) <= 1e-6) {
      diagnostics.warning("suspicious-gear", labels[k].at,
                          fmt::format("what {} can do hardly moves the teeth of {} along z of {}", name,
                                      labels[k].full_text(), model.marker(gear.cv).label->full_text()));
    }
    if (joints->rotates()) relation.terms.push_back({{i, marker_j, Displacement::rotation}, sign * b});
    if (joints->translates()) relation.terms.push_back({{i, marker_j, translation_of_joint}, sign * c});
  }

  std::vector<JointRelation> relations_;
};

}  // namespace

extern constinit const Kind gear = Kind{
    "GEAR",
    "",
    "Two gears on one carrier move alike at the pitch point.",
    Kind::Role::element,
    detail::argument_infos<Gear>,
    [](const Kind& kind) -> std::unique_ptr<ElementSet> {
      return std::make_unique<GearSet>(kind);
    }}.deactivatable();

}  // namespace dynalin
