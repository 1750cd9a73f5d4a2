#include "selected_modes/region_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/cycle.h"
#include "base/parallel.h"
#include "selected_modes/zero_search.h"

namespace dynalin {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Side = EigenvalueSearch::Side;

constexpr double beside_axis = 0.0137;  // shifts keep off the axis that undamped modes are on

std::vector<Complex> joined(std::vector<Complex> a, const std::vector<Complex>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

RegionSearch::RegionSearch(const PerturbationEquations& equations, ShiftInverse& op,
                           std::shared_ptr<const ConservativeModel> conservative, Progress progress)
    : equations_(equations),
      conservative_(std::move(conservative)),
      op_(op),
      progress_(std::move(progress)),
      counting_(counting_limits(op.states())) {
  start_anew();
  zero_.directions.resize(op_.states(), 0);
}

// Of small models factors cost nothing.
RegionSearch::CountingLimits RegionSearch::counting_limits(Index states) {
  constexpr Index small = 400;
  if (states <= small) return {1500, 5};
  if (states <= states_of_middling_models) return {150, 2};
  return {600, 5};
}

bool RegionSearch::find_zeros(const System& system, const Perturbation& perturbation) {
  progress_.tell("zeros");
  std::optional<ZerosFound> zeros;
  in_parallel(conservative_ ? 2 : 1, [&](std::size_t task) {
    if (task == 0) {
      zeros = zeros_near(system, perturbation, op_, *right_);
    } else {
      by_inertia_ = std::make_unique<InertiaCount>(conservative_);
    }
  });
  if (!zeros) return false;
  zero_ = std::move(zeros->zero), near_ = zeros->near, all_zeros_ = zeros->all;
  return true;
}

bool RegionSearch::find(const ModeSelection& selection) {
  selected_.doubt.clear();
  const auto* nearest = std::get_if<NearestModes>(&selection);
  const bool found = nearest ? find_nearest(*nearest) : find_band(std::get<ModesInBand>(selection));
  too_far_down_ = found && has_modes_too_far_down();
  by_inertia_.reset();
  return found;
}

void RegionSearch::start_anew() {
  if (conservative_) {
    auto right = std::make_unique<ConservativeSearch>(conservative_, op_, progress_);
    left_ = std::make_unique<LeftOfConservative>(*right);
    right_ = std::move(right);
  } else {
    right_ = std::make_unique<EigenvalueSearch>(op_, Side::right, progress_);
    left_ = std::make_unique<EigenvalueSearch>(op_, Side::left, progress_.of("left vectors"));
  }
}

bool RegionSearch::move_to(Complex shift) {
  progress_.tell([&] { return fmt::format("factors at {:.4g}", std::abs(shift) / cycle); });
  return op_.move_to(shift);
}

bool RegionSearch::too_many() const { return costs_more_than_all(*right_, op_.states()); }
// Near the imaginary axis at that height, where no undamped mode is; symmetric factors exist on it alone.

Complex RegionSearch::shift_at(double height) const {
  return conservative_ ? Complex(0, (1 + beside_axis) * height) : Complex(beside_axis * height, height);
}

// Structural zeros are exactly that.

std::vector<Complex> RegionSearch::values() const {
  std::vector<Complex> all = right_->values();
  std::stable_sort(all.begin(), all.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  for (Complex& v : all) {
    if (KnownModes::is_real(v, op_.shift())) v.imag(0);
  }
  // So small they are zeros of long chains, or next to it, scattered by rounding.
  const double scattered = 2e-3 * near();
  for (Complex& v : all) {
    if (std::abs(v) <= scattered) v.imag(0);
  }
  for (std::size_t k = 0; k < all.size() && k < static_cast<std::size_t>(zero_.count()); ++k) {
    if (std::abs(all[k]) <= near()) all[k] = 0;
  }
  return all;
}

double RegionSearch::near() const { return std::max(near_, zero_from_a_shift * std::abs(op_.shift())); }

// From shifts on the real axis both members of every pair are found.

bool RegionSearch::both_members() const { return region_.centre.imag() == 0 && region_.low == 0; }

Index RegionSearch::count_in(const ModeRegion& region) const {
  if (!both_members()) return region.count(known());
  const auto all = values();
  return static_cast<Index>(std::count_if(all.begin(), all.end(), [&](Complex v) { return region.has(v); }));
}
// Also what is in sight: no matter for the count, it only makes the determinant smoother.

std::vector<Complex> RegionSearch::places() const {
  return joined(known().all(), KnownModes(right_->in_sight(), op_.shift()).all());
}

ModeRegion RegionSearch::countable_region(int attempt) const {
  return countable(region_, KnownModes(joined(values(), right_->in_sight()), op_.shift()), attempt);
}

std::optional<Index> RegionSearch::counted_by_inertia() {
  counted_region_ = countable_region(0);
  return by_inertia_->eigenvalues_inside(counted_region_);
}
// How many there are more than are known: by the winding number around one border, and around others where that says
// anything else than 0. Nothing if they contradict each other.

std::optional<Index> RegionSearch::missing_by_winding() {
  const Complex shift = op_.shift();
  std::map<Index, int> said;
  std::optional<Index> missing;
  for (int attempt = 0; attempt < 5 && !missing && counting_.borders > 0; ++attempt) {
    counted_region_ = countable_region(attempt);
    // Of a band that is off the real axis the border is around its upper half alone.
    const bool half = !counted_region_.is_disc && counted_region_.low > 0;
    const auto counted = eigenvalues_inside(
        op_.factors(), counted_region_.border(), places(),
        [&](Complex v) { return counted_region_.has(v) && (!half || v.imag() > 0); }, counting_.factorizations,
        progress_.of("counting"));
    if (!counted) {
      --counting_.borders;
      continue;
    }
    const Index more = half ? 2 * *counted - count_in(counted_region_) : *counted - count_in(counted_region_);
    if (++said[more] == 2 || (more == 0 && said.size() == 1)) missing = more;
  }
  op_.move_to(shift);
  return missing;
}
// The modes in region_ and how many there ought to be; the search goes on where they differ.

bool RegionSearch::count() {
  constexpr Index few_unknowns = 10000;  // a count costs nothing there, and is a second opinion
  if (right_->everything() && equations_.unknowns() > few_unknowns) {
    // As many as there are states: factors have nothing to add.
    counted_region_ = countable_region(0);
    selected_.by = CountedBy::full_solution;
    selected_.found = selected_.counted = static_cast<std::size_t>(count_in(region_));
    missing_ = 0;
    return selected_.complete = true;
  }
  progress_.tell([&] { return fmt::format("counting, {} eigenvalues are found", right_->found()); });
  bool agreed = false;
  if (!by_inertia_ && conservative_) by_inertia_ = std::make_unique<InertiaCount>(conservative_);
  const std::optional<Index> counted = by_inertia_ ? counted_by_inertia() : std::nullopt;
  const std::optional<Index> missing =
      counted ? std::optional(*counted - count_in(counted_region_)) : missing_by_winding();
  if (missing) {
    const Index inside = count_in(region_);
    selected_.by = counted ? CountedBy::inertia : CountedBy::winding_number;
    selected_.found = static_cast<std::size_t>(inside);
    selected_.counted = static_cast<std::size_t>(std::max<Index>(0, inside + *missing));
    missing_ = *missing;
    agreed = missing_ == 0;
  } else {
    selected_.by = CountedBy::nothing;
  }
  selected_.complete = agreed;
  return agreed;
}

bool RegionSearch::find_nearest(const NearestModes& nearest) {
  if (nearest.frequency > 0 || from_ > 0) {
    start_anew();
    if (!move_to(nearest.frequency > 0 ? shift_at(cycle * nearest.frequency) : Complex(from_))) return false;
    op_.find_units();
  }
  const Index per_mode = nearest.frequency > 0 ? 1 : 2;
  Index target = static_cast<Index>(std::min(nearest.count, static_cast<std::size_t>(op_.states()))) * per_mode + 4;
  if (nearest.frequency == 0) target += zero_.count();
  constexpr double beyond_border = 1.3;
  int fruitless = 0, wider = 0;
  for (int round = 0; round < most_search_rounds && !too_many(); ++round) {
    const Index before = right_->found();
    if (right_->found() < target && !right_->everything()) right_->run(target - right_->found(), 0);
    const bool progress = right_->found() > before;
    const KnownModes modes = known();
    const auto zeros = std::count(modes.upper().begin(), modes.upper().end(), Complex(0));
    const auto disc = disc_of(nearest, modes, std::min<Index>(zero_.count(), zeros), right_->everything());
    if (!disc) {
      if (!progress && ++fruitless > 2) return false;
      target = std::max(target, right_->found()) + 6;
      continue;
    }
    region_ = *disc;
    if (nearest.count == 0 || modes.upper().empty()) {
      selected_.complete = true;
      return true;
    }
    // Inertia counts whatever was found: where it agrees, there is nothing to look for.
    if (conservative_ && count()) break;
    // From other start vectors as far as the border, until there is nothing more.
    if (look_for_more(reach_of_region())) continue;
    if ((!conservative_ && count()) || right_->everything()) break;
    // What is next to the border makes it countable, and may be nearer than some of what was found: a Krylov
    // iteration takes the outermost first.
    if (selected_.by == CountedBy::nothing) {
      const Index before_more = right_->found();
      right_->run(std::max<Index>(target / 2, 8), beyond_border * reach_of_region());
      if (right_->found() > before_more && ++wider < 4) continue;
    }
    if (++fruitless > 2) break;
  }
  selected_.radius_hz = region_.radius / cycle;
  return true;
}
// How far from the shift the disc reaches.

double RegionSearch::reach_of_region() const { return region_.radius + std::abs(op_.shift() - region_.centre); }
// Whether another start vector has found something in the region.

bool RegionSearch::look_for_more(double radius) {
  if (right_->everything()) return false;
  const Index before = right_->found(), inside = count_in(region_);
  right_->run(std::max<Index>(2, missing_ + 1), radius);
  return right_->found() > before && count_in(region_) > inside;
}

bool RegionSearch::find_band(const ModesInBand& band) {
  region_ = region_of(band);
  if (region_.high == 0) return find_nearest({0, 0});  // structural zeros alone
  start_anew();
  constexpr Index at_a_time = 30, enough_from_a_shift = 90, most_from_a_shift = 240;
  // So much farther than the heights of its part: what is next to the band, where it is counted, is then known too.
  constexpr double beyond = 1.3;
  std::size_t inside_before = 0;
  // The middle of the band, then of its halves, quarters …; on the real axis, for all from there.
  for (int level = 0; level < 6 && !too_many(); ++level) {
    const int parts = both_members() ? 1 : 1 << level;
    bool covered = true;
    for (int part = 0; part < parts; ++part) {
      const double half = 0.5 * (region_.high - region_.low) / parts;
      const double middle = region_.low + (2 * part + 1) * half;
      const Complex shift = both_members() ? Complex(beside_axis * region_.high) : shift_at(middle);
      if (!move_to(shift)) continue;
      if (level == 0) op_.find_units();
      right_->follow_shift();
      shifts_.push_back(shift);
      const double height = both_members() ? region_.high : half,
                   all = std::hypot(region_.right + shift.real(), height);
      bool reached = false;
      for (Index from_here = 0; from_here < most_from_a_shift && !reached && !right_->everything() && !too_many();) {
        const Index before = right_->found();
        right_->run(at_a_time, all);
        from_here += right_->found() - before;
        const bool far_enough = right_->reached() >= beyond * height && (level > 0 || from_here >= enough_from_a_shift);
        reached = right_->found() == before || right_->reached() >= all || far_enough;
      }
      covered = covered && (reached || right_->everything());
    }
    if (shifts_.empty() || !covered) continue;
    for (int round = 0; round < most_search_rounds && !too_many(); ++round) {
      if (!look_for_more(std::hypot(region_.right, 0.5 * (region_.high - region_.low)))) break;
    }
    if (count() || right_->everything()) return true;
    // It cannot be counted, and smaller parts have brought nothing: nor will others.
    const auto inside = static_cast<std::size_t>(count_in(region_));
    if (selected_.by == CountedBy::nothing && level > 0 && inside == inside_before) break;
    inside_before = inside;
  }
  return !shifts_.empty();
}

// Counted, as nothing that was found there can be relied on.
bool RegionSearch::has_modes_too_far_down() {
  constexpr double told_apart = 1e-4;  // of moduli, 1e-8 of their squares
  if (!conservative_ || both_members()) return false;
  double floor = told_apart * std::abs(op_.shift());
  for (const Complex& shift : shifts_) floor = std::max(floor, told_apart * std::abs(shift));
  const double low = region_.is_disc ? region_.centre.imag() - region_.radius : region_.low;
  if (low >= floor) return false;
  if (!by_inertia_) by_inertia_ = std::make_unique<InertiaCount>(conservative_);
  const auto up_to = by_inertia_->below(floor * floor),
             from = by_inertia_->below(region_.is_disc ? -floor * floor : low * low);
  // Each freedom that nothing holds has two zeros; no band with a border below has any.
  return !up_to || !from || 2 * (*up_to - *from) > (region_.is_disc ? zero_.count() : 0);
}

}  // namespace dynalin
