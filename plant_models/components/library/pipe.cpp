#include "plant_models/components/library/fluid.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kIn, kOut, kFlowOut };
enum Fault : std::size_t { kBlocked };

class Pipe final : public Through {
 public:
  explicit Pipe(const Parameters& p)
      : Through(kIn, kOut),
        flow_(p["flow"]),
        drop_(p["pressure_drop"]),
        rise_pa_(p["rise"] * p.weight()),
        laminar_(p.is("law", "laminar")),
        one_way_(p.is("check_valve", "yes")) {}

  void evaluate(std::uint32_t, const Frame& f) const override {
    const double relative = (pressure_drop(f) - rise_pa_) / drop_;
    double wanted = (laminar_ ? flow_ * relative : turbulent(flow_, relative)) * (1.0 - fault(kBlocked));
    if (one_way_ && wanted < 0.0) wanted = 0.0;
    across(f, kFlowOut) = set_flow(f, wanted);
  }

 private:
  double flow_, drop_, rise_pa_;
  bool laminar_, one_way_;
};

}  // namespace

ComponentType pipe_type() {
  return {.name = "pipe",
          .meaning = "a pipe or hose between two places: flow by the difference of pressure",
          .parameters = {{.name = "flow",
                          .unit = "m3/s",
                          .fallback = "",
                          .low = 1e-12,
                          .high = 1e4,
                          .meaning = "at the pressure drop"},
                         {.name = "pressure_drop",
                          .unit = "Pa",
                          .fallback = "",
                          .low = 1e-3,
                          .high = 1e9,
                          .meaning = "at the flow"},
                         {.name = "rise",
                          .unit = "m",
                          .fallback = "0 m",
                          .low = -1e4,
                          .high = 1e4,
                          .meaning = "of its end over its beginning"},
                         {.name = "law",
                          .unit = "",
                          .fallback = "turbulent",
                          .meaning = "flow by the root of the drop, or (laminar) by the drop",
                          .choices = {"turbulent", "laminar"}},
                         {.name = "check_valve",
                          .unit = "",
                          .fallback = "no",
                          .meaning = "whether nothing flows back",
                          .choices = {"no", "yes"}}},
          .ports = {{.name = "in", .kind = PortKind::Fluid, .reads = 0, .meaning = "where it begins"},
                    {.name = "out", .kind = PortKind::Fluid, .reads = 0, .meaning = "where it ends"},
                    {.name = "flow_out",
                     .role = Role::Node,
                     .unit = "l/s",
                     .open = Open::Fine,
                     .meaning = "from beginning to end"}},
          .faults = {{.name = "blocked",
                      .unit = "percent",
                      .low = 0.0,
                      .high = 100.0,
                      .rest = 0.0,
                      .meaning = "by this much less flows"}},
          .make = [](const Parameters& p) { return std::make_unique<Pipe>(p); }};
}

}  // namespace stepwright::components::library
