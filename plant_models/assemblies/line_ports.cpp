#include "plant_models/assemblies/line_ports.h"

#include <string>
#include <utility>

namespace stepwright::assemblies {
namespace {

using core::PortKind;

std::string number(std::size_t n) {
  return std::to_string(n);
}

class Builder {
 public:
  Builder(const LineLayout& layout, std::size_t boxes) : layout_(layout), boxes_(boxes) {}

  LinePorts build() {
    add_actuators();
    add_switches();
    add_counts();
    add_box_truths();
    add_line_truths();
    add_faults();
    return std::move(ports_);
  }

 private:
  void actuator(LineActuator kind, std::size_t index, std::string name, std::string meaning) {
    ports_.actuators.push_back({std::move(name), PortKind::Bool, std::move(meaning)});
    ports_.actuator_targets.push_back({kind, index});
  }
  void sensor(LineSensor kind, std::size_t index, std::string name, PortKind port, std::string meaning) {
    ports_.sensors.push_back({std::move(name), port, std::move(meaning)});
    ports_.sensor_targets.push_back({kind, index});
  }
  void truth(LineTruth kind, std::size_t index, std::string name, std::string unit, std::string meaning) {
    ports_.truths.push_back({std::move(name), std::move(unit), std::move(meaning)});
    ports_.truth_targets.push_back({kind, index});
  }
  void fault(LineFault kind, std::size_t index, std::string name, std::string meaning,
             FaultRange range = {}) {
    ports_.faults.push_back({std::move(name), "", std::move(meaning)});
    ports_.fault_targets.push_back({kind, index});
    ports_.fault_ranges.push_back(range);
  }

  void add_actuators() {
    for (std::size_t i = 0; i < layout_.belts.size(); ++i) {
      const std::string& name = layout_.belts[i].name;
      actuator(LineActuator::Belt, i, "belt_" + name,
               "runs the belt " + name + ", while the contactor is closed");
    }
    for (std::size_t i = 0; i < layout_.pushers.size(); ++i) {
      const std::string& name = layout_.pushers[i].name;
      actuator(LineActuator::Pusher, i, "push_" + name,
               "sends pusher " + name + " out, while the contactor is closed; off: it comes back");
    }
    actuator(LineActuator::Contactor, 0, "contactor",
             "closes the contactor behind which all drives and valves are; the emergency stop opens it");
  }

  void add_switches() {
    for (std::size_t i = 0; i < layout_.eyes.size(); ++i) {
      const std::string& name = layout_.eyes[i].name;
      sensor(LineSensor::Eye, i, "eye_" + name, PortKind::Bool, "a box is in front of the photo-eye " + name);
    }
    for (std::size_t i = 0; i < layout_.pushers.size(); ++i) {
      const std::string& name = layout_.pushers[i].name;
      sensor(LineSensor::Home, i, "home_" + name, PortKind::Bool, "pusher " + name + " is all the way back");
      sensor(LineSensor::Out, i, "out_" + name, PortKind::Bool, "pusher " + name + " is all the way out");
    }
    sensor(LineSensor::Contactor, 0, "contactor_closed", PortKind::Bool, "feedback contact of the contactor");
    sensor(LineSensor::EmergencyStop, 0, "estop_ok", PortKind::Bool,
           "off while the emergency stop is pressed");
    sensor(LineSensor::Reset, 0, "reset", PortKind::Bool, "the reset button is pressed");
  }

  void add_counts() {
    sensor(LineSensor::Reader, 0, "reader", PortKind::Count,
           "number of the box that the reader sees, 0 = none");
    sensor(LineSensor::ReaderLength, 0, "reader_length", PortKind::Count,
           "length of the box that the reader sees, mm; 0 = none");
    sensor(LineSensor::ReaderColour, 0, "reader_colour", PortKind::Count,
           "colour of the box that the reader sees, 1 to 3; 0 = none");
    for (std::size_t i = 0; i < layout_.chutes.size(); ++i) {
      sensor(LineSensor::Counter, i, "count_" + number(i + 1), PortKind::Count,
             "boxes that passed the counter of chute " + number(i + 1));
    }
  }

  void add_box_truths() {
    for (std::size_t i = 0; i < boxes_; ++i) {
      const std::string name = "box_" + number(i + 1);
      const std::string box = "box " + number(i + 1);
      truth(LineTruth::BoxState, i, name + "_state", "",
            box + ": 0 announced, 1 on the line, 2 delivered, 3 taken away, 4 fallen off the line");
      truth(LineTruth::BoxChute, i, name + "_chute", "", "chute that got " + box + "; 0 = none");
      truth(LineTruth::BoxRank, i, name + "_rank", "",
            "place of " + box + " among those its chute got; 0 = none");
      truth(LineTruth::BoxX, i, name + "_x", "m", "middle of " + box + " along the main line");
      truth(LineTruth::BoxY, i, name + "_y", "m", "middle of " + box + " beside the main line");
      truth(LineTruth::BoxAngle, i, name + "_angle", "rad", "how far " + box + " is turned");
    }
  }

  void add_line_truths() {
    for (std::size_t i = 0; i < layout_.belts.size(); ++i) {
      truth(LineTruth::BeltSpeed, i, "speed_" + layout_.belts[i].name, "m/s",
            "speed of the belt " + layout_.belts[i].name);
    }
    for (std::size_t i = 0; i < layout_.pushers.size(); ++i) {
      truth(LineTruth::PusherTravel, i, "travel_" + layout_.pushers[i].name, "m",
            "how far pusher " + layout_.pushers[i].name + " is out");
    }
    truth(LineTruth::Delivered, 0, "delivered", "", "boxes that left through chutes");
    truth(LineTruth::OnTheLine, 0, "on_the_line", "", "boxes on belts and chutes");
    truth(LineTruth::Energy, 0, "energy", "J", "kinetic energy of all boxes");
    truth(LineTruth::GreatestForce, 0, "greatest_force", "N", "the most that a box was pressed with so far");
    truth(LineTruth::Collisions, 0, "collisions", "",
          "how often a pusher began to push at a running belt, or a belt began to run below a pusher that "
          "was out");
  }

  void add_faults() {
    for (std::size_t i = 0; i < layout_.belts.size(); ++i) {
      const std::string& name = layout_.belts[i].name;
      fault(LineFault::Obstacle, i, "jam_" + name, "1: something stands in the way on the belt " + name);
    }
    for (std::size_t i = 0; i < layout_.pushers.size(); ++i) {
      const std::string& name = layout_.pushers[i].name;
      fault(LineFault::StuckPusher, i, "stuck_push_" + name, "1: pusher " + name + " stays where it is");
    }
    for (std::size_t i = 0; i < layout_.eyes.size(); ++i) {
      const std::string& name = layout_.eyes[i].name;
      fault(LineFault::StuckEye, i, "stuck_eye_" + name, "eye_" + name + " shows 0 or 1 whatever is there");
    }
    for (std::size_t i = 0; i < layout_.belts.size(); ++i) {
      const std::string& name = layout_.belts[i].name;
      fault(LineFault::Slip, i, "slip_" + name, "the belt " + name + " has this share of its grip",
            {0, 1, false});
    }
    const auto last = static_cast<double>(boxes_);
    fault(LineFault::TakenAway, 0, "lose_box", "somebody takes the box of this number off the line",
          {1, last});
    fault(LineFault::Exchange, 0, "exchange_boxes",
          "the announced box of this number and the one behind it arrive in the other order", {1, last - 1});
    fault(LineFault::EmergencyStop, 0, "press_estop", "1: the emergency stop is pressed");
    fault(LineFault::Reset, 0, "press_reset", "1: the reset button is pressed");
  }

  const LineLayout& layout_;
  std::size_t boxes_;
  LinePorts ports_;
};

}  // namespace

LinePorts make_ports(const LineLayout& layout, std::size_t boxes) {
  return Builder(layout, boxes).build();
}

core::PlantDescription describe_line(const LineParameters& parameters) {
  const LineLayout layout = make_layout(parameters);
  core::PlantDescription d;
  d.name = "sorting line";
  for (const BeltPlace& belt : layout.belts) {
    d.belts.push_back({belt.name, "belt_" + belt.name, "speed_" + belt.name, belt.area.low.x, belt.area.low.y,
                       belt.area.high.x, belt.area.high.y, belt.direction.x, belt.direction.y});
  }
  for (std::size_t i = 0; i < layout.chutes.size(); ++i) {
    const ChutePlace& chute = layout.chutes[i];
    d.belts.push_back({"chute " + number(i + 1), "", "", chute.area.low.x, chute.area.low.y,
                       chute.area.high.x, chute.area.high.y, chute.direction.x, chute.direction.y});
  }
  for (const EyePlace& eye : layout.eyes) {
    d.beams.push_back({"eye_" + eye.name, eye.from.x, eye.from.y, eye.to.x, eye.to.y});
  }
  for (const PusherPlace& p : layout.pushers) {
    d.pushers.push_back({p.name, "push_" + p.name, "travel_" + p.name, p.home.x, p.home.y, p.length_m,
                         parameters.pusher.thickness_m, p.direction.x, p.direction.y, p.stroke_m});
  }
  const std::vector<BoxData> boxes = make_boxes(parameters);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::string name = "box_" + number(i + 1);
    d.boxes.push_back({number(i + 1), boxes[i].rectangle.size.x, boxes[i].rectangle.size.y, name + "_state",
                       name + "_x", name + "_y", name + "_angle"});
  }
  return d;
}

}  // namespace stepwright::assemblies
