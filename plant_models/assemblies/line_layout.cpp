#include "plant_models/assemblies/line_layout.h"

namespace stepwright::assemblies {
namespace {

constexpr double kInfeedExtra = 0.2;    // the infeed is longer than a zone by this
constexpr double kEyeBeforeEnd = 0.15;  // a box that stops at its eye does not reach the next belt
constexpr double kRail = 0.02;          // between a belt and its rail
constexpr double kGap = 0.15;           // between the main line and the lane: paddles of diverters park there
constexpr double kPaddleGap = 0.03;     // between a belt and a paddle that parks beside it
constexpr double kFarSide = 0.10;       // how far from the far side of a belt an eye sees that a box is on it
constexpr double kReaderX = 0.62;       // of the reader's eye; covered by boxes from both sides
constexpr double kLaneStopX = 0.50;     // of the eye at the end of the lane
constexpr double kChuteLength = 1.2;
constexpr double kCounter = 0.35;  // from the beginning of a chute to its counter

class Builder {
 public:
  explicit Builder(const LineParameters& p) : p_(p), half_(p.belt_m / 2.0), lane_low_(half_ + kGap) {}

  LineLayout build() {
    add_main_line();
    add_lane();
    for (std::size_t i = 0; i < p_.diverters; ++i) add_diverter(i);
    add_transfers();
    add_end_chute();
    add_rails();
    layout_.arrival = {-p_.zone_m, 0.0};
    layout_.bounds = {{begin() - 0.1, -half_ - kChuteLength - 0.1},
                      {end() + kChuteLength + 0.1, lane_high() + 0.6}};
    return std::move(layout_);
  }

 private:
  double begin() const { return -p_.zone_m - kInfeedExtra; }
  double end() const { return p_.zone_m * static_cast<double>(p_.diverters + 2); }
  double lane_high() const { return lane_low_ + p_.belt_m; }
  // End of the n-th belt behind the infeed, from 1.
  double end_of(std::size_t n) const { return p_.zone_m * static_cast<double>(n); }

  void add_belt(std::string name, double from, double to) {
    const double eye = name == "r" ? kReaderX : to - kEyeBeforeEnd;
    // The reader's eye looks down at one point: a box that comes from the lane is on the belt as a whole
    // then.
    const double low = name == "r" ? -half_ + 0.18 : -half_;
    const double high = name == "r" ? low : half_;
    layout_.eyes.push_back({name, {eye, low}, {eye, high}});
    layout_.belts.push_back({std::move(name), {{from, -half_}, {to, half_}}, {1.0, 0.0}});
  }

  void add_main_line() {
    add_belt("in", begin(), 0.0);
    add_belt("r", 0.0, end_of(1));
    for (std::size_t i = 1; i <= p_.diverters; ++i) {
      add_belt("d" + std::to_string(i), end_of(i), end_of(i + 1));
    }
    add_belt("e", end_of(p_.diverters + 1), end());
  }

  void add_lane() {
    layout_.belts.push_back({"t", {{kLaneStopX - 0.2, lane_low_}, {end(), lane_high()}}, {-1.0, 0.0}});
    layout_.eyes.push_back({"t", {kLaneStopX, lane_low_}, {kLaneStopX, lane_high()}});
    const double far = lane_high() - kFarSide;
    layout_.eyes.push_back({"t1", {end() - 0.35, far}, {end() - 0.20, far}});
  }

  void add_pusher(std::string name, std::size_t belt, double middle_x, double home_y, double way,
                  double stroke) {
    layout_.pushers.push_back({std::move(name), belt, 0.5, {middle_x, home_y}, {0.0, way}, stroke});
  }

  // Pushes to the right of the way, over the belt's lower edge into its chute.
  void add_diverter(std::size_t i) {
    const double end_x = end_of(i + 2);
    const double paddle = half_ + kPaddleGap + p_.pusher.thickness_m / 2.0;
    add_pusher(std::to_string(i + 1), i + 2, end_x - 0.33, paddle, -1.0, p_.belt_m + 0.20);
    const double low = end_x - 0.66;
    const double high = end_x - 0.02;
    const double bottom = -half_ - kChuteLength;
    layout_.chutes.push_back({{{low, bottom}, {high, -half_}},
                              {0.0, -1.0},
                              {low, -half_ - kCounter},
                              {high, -half_ - kCounter},
                              {{low, bottom - 1.0}, {high, bottom + 0.1}}});
    add_wall({low, -half_ - kRail}, {low, bottom});
    add_wall({high, -half_ - kRail}, {high, bottom});
  }

  // From the end of the line into the lane, and from the lane back to the reader.
  void add_transfers() {
    const double beside = kPaddleGap + p_.pusher.thickness_m / 2.0;
    const double onto_lane = p_.belt_m + kGap + kPaddleGap + 0.17;
    add_pusher("e", layout_.end(), end() - 0.33, -half_ - beside, 1.0, onto_lane);
    add_pusher("t", layout_.lane(), kLaneStopX + 0.16, lane_high() + beside, -1.0, onto_lane);
  }

  void add_end_chute() {
    const double last = end() + kChuteLength;
    layout_.chutes.push_back({{{end(), -half_}, {last, half_}},
                              {1.0, 0.0},
                              {end() + kCounter, -half_},
                              {end() + kCounter, half_},
                              {{last - 0.1, -half_}, {last + 1.0, half_}}});
  }

  void add_wall(Vec2 from, Vec2 to) { layout_.walls.push_back({from, to}); }

  // Open where boxes are pushed over the edge.
  void add_rails() {
    const double low = -half_ - kRail;
    const double high = half_ + kRail;
    const double last = end() + kChuteLength;
    double from = begin();
    for (std::size_t i = 0; i < p_.diverters; ++i) {
      add_wall({from, low}, {layout_.chutes[i].area.low.x, low});
      from = layout_.chutes[i].area.high.x;
    }
    add_wall({from, low}, {end_of(p_.diverters + 1) + 0.1, low});
    add_wall({end() - 0.05, low}, {last, low});
    // The lane's openings lead over both upper rails.
    const double open_low = kLaneStopX + 0.46;
    const double open_high = end() - 0.72;
    add_wall({begin(), high}, {kLaneStopX - 0.18, high});
    add_wall({kLaneStopX - 0.18, high}, {kLaneStopX - 0.18, lane_high() + kRail});  // the end of the lane
    add_wall({open_low, high}, {open_high, high});
    add_wall({open_low, lane_low_ - kRail}, {open_high, lane_low_ - kRail});
    add_wall({end() + kRail, high}, {last, high});
    add_wall({end() + kRail, high}, {end() + kRail, lane_high() + kRail});
    add_wall({open_low, lane_high() + kRail}, {end() + kRail, lane_high() + kRail});
  }

  const LineParameters& p_;
  double half_;
  double lane_low_;
  LineLayout layout_;
};

}  // namespace

LineLayout make_layout(const LineParameters& parameters) {
  return Builder(parameters).build();
}

}  // namespace stepwright::assemblies
