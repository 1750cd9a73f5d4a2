// One draw of a random mechanism; random_mechanism repeats it until a draw is acceptable.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "accepted_draws.h"
#include "model.h"

namespace dynalin::oracle {

struct Frame {
  Vec p;
  Mat R;
};

// Solids that touch, the second one as a cavity or not, and where on it. Regular: a frustum that is a cylinder, an
// ellipsoid that is a sphere.
enum class Spot { any, face, edge, mantle, end };
struct Meeting {
  SolidShape first;
  bool first_regular;
  SolidShape second;
  bool second_regular, in_cavity;
  Spot spot;
};

// What rubs in a draw that insists on it: its first joint.
enum class RubRegime { stiction, transition, sliding, lugre };
inline constexpr std::array rubbing_joints = {JointType::translational, JointType::revolute,  JointType::cylindrical,
                                              JointType::hooke,         JointType::universal, JointType::spherical};
// Seeds of which each joint rubs in each regime, and the seed behind the last.
inline constexpr std::uint64_t first_of_friction = 331, behind_friction = 355;

// Nodes of a flexible body are one to the program.
[[nodiscard]] inline bool are_one_body(const BodyRef& a, const BodyRef& b) {
  return a == b || (a.kind == BodyKind::flexible_node && b.kind == a.kind && a.id / 100 == b.id / 100);
}

class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t attempt)
      : random_(seed * 1000003U + attempt * 7919U + 17U),
        friction_random_(seed * 7368787U + attempt * 104729U + 5U),
        touch_random_(seed * 1299709U + attempt * 15485863U + 3U),
        beam_random_(seed * 179424673U + attempt * 32452843U + 11U),
        state_random_(seed * 86028121U + attempt * 49979687U + 7U),
        flexible_random_(seed * 122949823U + attempt * 67867967U + 13U),
        wanted_loops_(seed % 10 == 0 ? 2 : (seed % 5 < 2 ? 1 : 0)),
        wanted_motions_(seed % 3 == 0 ? 1 : 0),
        whole_language_(seed > 200),
        must_touch_(seed > 220 && seed <= 240),
        must_bend_(seed > 240 && seed <= 260),
        must_call_(seed > 260 && seed <= 270),
        must_deform_((seed > 270 && seed <= 280) || (seed >= behind_friction && seed < 360)),
        plane_(seed > 280 && seed <= 290 ? static_cast<BeamPlane>(1 + seed % 3) : BeamPlane::none),
        meeting_(seed > 290 && seed <= 310 ? static_cast<int>((seed - 291) % 10) : -1),
        must_ride_(seed > 310 && seed <= 320),
        must_float_(seed > 320 && seed <= 330),
        rubbing_(seed >= first_of_friction && seed < behind_friction ? static_cast<int>(seed - first_of_friction) : -1),
        must_spin_(seed >= behind_friction && seed < 360),
        may_rub_(seed % 2 == 0 || rubbing_ >= 0) {}
  // One that was found acceptable before: it is made without another look at that.
  Draw(std::uint64_t seed, const AcceptedDraw& known) : Draw(seed, known.attempt) {
    known_softenings_ = known.softenings;
  }
  [[nodiscard]] Mechanism mechanism();
  // How many times friction was made less in it.
  [[nodiscard]] int softenings() const { return softenings_; }

 private:
  // The standard distributions differ between libraries; the bits of the engine do not.
  double uniform(double a, double b) { return a + (b - a) * std::ldexp(static_cast<double>(random_() >> 11U), -53); }
  bool chance(double p) { return uniform(0, 1) < p; }
  int pick(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  template <class T>
  const T& one_of(const std::vector<T>& list) {
    return list[static_cast<std::size_t>(pick(static_cast<int>(list.size())))];
  }
  Vec box(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Mat orientation() { return rotation_313(uniform(-3, 3), uniform(0.2, 2.9), uniform(-3, 3)); }

  void draw_units();
  void add_body(BodyKind kind);
  int add_marker(const BodyRef& body, const Frame& global);
  void connect(const BodyRef& i_body, const BodyRef& j_body, JointType type);
  void draw_tree();
  void draw_loops();
  void draw_screws();
  void draw_couplers();
  void draw_gears();
  int draw_curve(bool plane);
  void draw_contacts();
  void place_contact(const BodyRef& i_body, const BodyRef& j_body, bool two_curves);
  void draw_planes();
  void place_plane(const BodyRef& i_body, const BodyRef& j_body);
  void draw_axis();
  // A place on a curve of the second body, global; the direction of the curve there and its derivative in axes of J.
  struct OnCurve {
    Contact contact;
    Frame J;
    Vec at, slope, bend;
    bool is_smooth = false;  // the place is no knot, nor is the curve bent sharply there
  };
  OnCurve draw_on_curve(const BodyRef& i_body, const BodyRef& j_body);
  void add_contact(const OnCurve& on);
  int add_floating(const BodyRef& on);
  void place_axis(const BodyRef& i_body, const BodyRef& j_body);
  void draw_contact_starts();
  void draw_motions();
  void draw_position_gcon();
  void draw_velocity_gcon();
  void draw_massless();
  void draw_measure_markers();
  void draw_velocities();
  void draw_springs();
  void draw_linear_forces();
  void draw_nforces();
  void draw_cable();
  void draw_journal();
  void draw_general_forces();
  void draw_controls();
  void draw_differential_elements();
  void draw_gse();
  void read_gse();
  void draw_diff_functions();
  void draw_algebraic_diffs();
  void draw_sforces();
  void draw_outputs();
  void draw_frictions();
  void draw_touches();
  void draw_touch();
  void draw_touch_law(Touch& touch);
  void draw_meetings();
  void draw_meeting(const Meeting& meeting);
  Solid solid(SolidShape shape, bool regular, double size);
  void check_regimes(const Touch& touch) const;
  void draw_beams();
  void draw_beam();
  struct SectionDraw {
    double flatness, skewed, lightest, heaviest;  // IZZ by IYY, how often there is an IYZ, mass by length
  };
  void draw_sections(Beam& b, std::size_t n, const SectionDraw& d);
  void add_bodies_of(const Beam& beam);
  void join_beam(const Beam& beam);
  void draw_plane_beam();
  void join_plane_beam(const Beam& beam);
  void draw_beam_load();
  void draw_flexibles();
  void draw_flexible();
  void join_flexible(const Flexible& flexible);
  void ride_on(const BodyRef& node, const std::vector<BodyRef>& solid);
  void react_on(const BodyRef& body, int id);
  void draw_modal_forces();
  void check_frictions(const Model& model) const;
  [[nodiscard]] RubRegime wanted_regime() const {
    return static_cast<RubRegime>(static_cast<std::size_t>(rubbing_) / rubbing_joints.size());
  }
  [[nodiscard]] JointType wanted_joint() const {
    return rubbing_joints[static_cast<std::size_t>(rubbing_) % rubbing_joints.size()];
  }
  void rub_as_wanted(Friction& friction, double speed);
  void check_structure() const;
  void check() const;
  void check_nodes(const Model& model, const Expr& e) const;

  Expr displacement();
  Expr angle();
  Expr velocity();
  Expr acceleration();
  Expr reaction();
  Expr load();
  Expr net_load();
  Expr contact_load();
  Expr at_contact(int order);
  Expr rate() { return one_of(rates_); }
  Expr kinematic() {
    const int order = pick(2);
    if (here_ && !floating_.empty() && chance(0.25)) return at_contact(order);
    return order == 0 ? displacement() : velocity();
  }
  // A smooth function of an argument of order one, so that second and higher derivatives matter.
  Expr shaped(const Expr& x);
  Expr curved(const Expr& x);
  Expr series(const Expr& x);
  Expr interpolated(const Expr& x);
  Expr signal(const Expr& x);
  Expr delayed_signal(bool of_states);
  // Of something kinematic also functions that are smooth in pieces: a piece that holds its present value.
  Expr shaped_kinematic();
  Expr in_pieces(const Expr& x);
  Expr contact(const Expr& x, double now);
  [[nodiscard]] double now(const Expr& x) const { return static_cast<double>(here_->evaluate(x)); }
  std::vector<Expr> constants(std::initializer_list<double> values) {
    std::vector<Expr> list;
    for (const double v : values) list.push_back(constant(v));
    return list;
  }
  Expr feature(int self);
  std::pair<int, int> distant_pair(bool oriented_j);
  // Alone against ground only a marker that moves says anything.
  [[nodiscard]] int moving(int i, int j) const { return body_of(i) == ground ? j : i; }
  [[nodiscard]] const Marker& marker(int id) const;
  [[nodiscard]] BodyRef body_of(int marker_id) const;
  // In the global frame, of one that is fixed on its body.
  [[nodiscard]] Vec place_of(int marker_id) const;
  [[nodiscard]] const Body& body(const BodyRef& ref) const;
  [[nodiscard]] int mobility() const;
  int variable(const Expr& e) {
    m_.variables.push_back({next_variable_, e});
    return next_variable_++;
  }

  // Frictions have numbers of their own: what else a seed draws is what it was before there were any.
  std::mt19937_64 random_, friction_random_, touch_random_, beam_random_, state_random_, flexible_random_;
  // Rejection starves loops and motions; some seeds insist on them.
  int wanted_loops_ = 0, wanted_motions_ = 0;
  bool whole_language_ = false;        // the first 200 stay as they were drawn when there were fewer elements
  bool must_touch_ = false;            // shapes, from 221 to 240
  bool must_bend_ = false;             // a beam, from 241 to 260
  bool must_call_ = false;             // compiled routines, from 261 to 270
  bool must_deform_ = false;           // a flexible body, from 271 to 280 and from 355 to 359
  BeamPlane plane_ = BeamPlane::none;  // of a beam, from 281 to 290: each in turn
  int meeting_ = -1;                   // the first of four pairs of solids, from 291 to 310
  bool must_ride_ = false;             // an axis along a curve, from 311 to 320
  bool must_float_ = false;            // a shaft on a film, from 321 to 330
  int rubbing_ = -1;                   // which joint rubs in which regime, from 331 to 354
  bool must_spin_ = false;             // a flexible body as fast as it vibrates, from 355 to 359
  bool may_rub_ = false;               // every second seed
  std::optional<int> known_softenings_;
  int softenings_ = 0;
  Mechanism m_;
  double L_ = 1, F_ = 10;  // natural length and force
  std::vector<BodyRef> bodies_{ground};
  std::vector<std::pair<BodyRef, BodyRef>> connected_;
  std::vector<int> oriented_;  // measure markers on ground and parts
  std::vector<int> all_;       // those and the ones on point masses
  std::vector<int> floating_;  // at points of contact where the curve is bent, so that it has axes
  std::vector<int> features_, inputs_;
  std::vector<Expr> states_;   // DIF and ARYVAL of what the control elements offer
  std::vector<Expr> rates_;    // DIF1
  std::optional<Model> here_;  // at the drawn point, once it is known
  int next_marker_ = 1, next_variable_ = 1, next_array_ = 1, next_matrix_ = 1;
};

}  // namespace dynalin::oracle
