#include "cell/missions/tamp/arms_cell.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cell/missions/mission_kinds.h"
#include "cell/missions/tamp/arms_wires.h"
#include "cell/missions/tamp/check_cell.h"
#include "cell/missions/tamp/table/tamp_table.h"
#include "cell/monitors/cell_monitors.h"
#include "runtime/ground/files/files.h"
#include "supervisor/tamp/scene/cell_file.h"

namespace stepwright::missions {
namespace {

using namespace tamp::mission;

const TampTable& tamp_table(const config::CellConfig& config) {
  return *table_as<TampTable>(config.mission.table);
}

// What is wrong with a goal is told where the cell's file has it.
void take_at(const result::Location& where, const result::Diagnostics& found, result::Diagnostics& wrong) {
  for (result::Diagnostic each : found) {
    each.where = where;
    wrong.push_back(std::move(each));
  }
}

result::Result<std::vector<ArmsOrder>> orders_of(const TampTable& table, const tamp::scene::RobotCell& cell,
                                                 std::size_t& first) {
  std::vector<ArmsOrder> orders;
  result::Diagnostics wrong;
  for (const TampOrder& each : table.orders) {
    auto order = read_order(cell, each.name, each.goal, each.where.file);
    if (!order) {
      take_at(each.where, order.error(), wrong);
      continue;
    }
    if (each.name == table.order) first = orders.size();
    orders.push_back(*std::move(order));
  }
  if (table.order.starts_with('(')) {
    auto order = read_order(cell, table.order, table.order, table.order_where.file);
    if (!order) {
      take_at(table.order_where, order.error(), wrong);
    } else {
      first = orders.size();
      orders.push_back(*std::move(order));
    }
  }
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  return orders;
}

result::Result<lisp::Source> domain_of(const TampTable& table, const tamp::scene::CellFile& file) {
  const std::filesystem::path path = table.domain.empty() ? file.domain : table.domain;
  if (path.extension() != ".pddl")
    return result::fail("G0408", table.where, "the problem's domain is no PDDL: orders need one",
                        "domain = \"stacking_arms.pddl\" in [tamp]");
  auto text = files::read_file(path.string());
  if (!text) return result::forward(text);
  return lisp::Source{path.string(), *std::move(text)};
}

// What is asked for at given times.
result::Result<std::vector<TimedArmsRequest>> requests_of(const TampTable& table,
                                                          const ArmsPlanning& planning) {
  std::vector<TimedArmsRequest> requests;
  result::Diagnostics wrong;
  for (const TampAsked& asked : table.requests) {
    if (asked.request == "goal") {
      if (auto good = planning.order(asked.goal); !good) take_at(asked.where, good.error(), wrong);
      requests.push_back({asked.at_s, GoalChange{asked.goal}});
    }
    if (asked.request == "hold") requests.push_back({asked.at_s, HoldChange{}});
    if (asked.request == "resume") requests.push_back({asked.at_s, ResumeChange{}});
  }
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  std::ranges::stable_sort(requests, {}, &TimedArmsRequest::at_s);
  return requests;
}

}  // namespace

result::Result<ArmsPlanning> open_arms_planning(const config::CellConfig& config) {
  const TampTable& table = tamp_table(config);
  auto file = tamp::scene::load_cell(table.problem);
  if (!file) return result::forward(file);
  if (auto good = check_agrees(config.plant, file->cell, table.where); !good) return result::forward(good);
  ArmsPlanningOptions options;
  auto orders = orders_of(table, file->cell, options.first);
  if (!orders) return result::forward(orders);
  for (const std::string& each : table.exchange) {
    options.exchange.push_back(file->cell.surface(each));
    if (options.exchange.back() < 0)
      return result::fail("G0401", table.exchange_where, "the cell has no region '" + each + "'",
                          "exchange = [\"box-top\"], regions of the problem");
  }
  auto domain = domain_of(table, *file);
  if (!domain) return result::forward(domain);
  auto terminals = terminals_of(config, file->cell);
  if (!terminals) return result::forward(terminals);
  auto monitors = cell_monitors::cell_monitors(config);
  if (!monitors) return result::forward(monitors);
  options.cell = std::move(file->cell);
  options.warnings = std::move(file->warnings);
  options.domain = *std::move(domain);
  options.orders = *std::move(orders);
  options.terminals = *std::move(terminals);
  options.program = program_options();
  options.program.interval_us = config.clock.interval_us;
  options.program.camera_every = table.pictures;
  options.program.following_rad = table.following_rad;
  options.seed = table.seed;
  options.most_s = table.time_s;
  options.watchers = cell_monitors::watchers_of(*monitors);
  return ArmsPlanning::open(std::move(options));
}

result::Result<ArmsMissionOptions> arms_options(const config::CellConfig& config,
                                                const ArmsPlanning& planning) {
  const run::MissionOptions options = mission_options(config);
  const TampTable& table = tamp_table(config);
  auto requests = requests_of(table, planning);
  if (!requests) return result::forward(requests);
  return ArmsMissionOptions{.cell = options.cell,
                            .max_replans = config.executive.max_replans,
                            .retries = table.retries,
                            .operator_starts = options.operator_starts,
                            .barrier = options.barrier,
                            .attended = table.attended,
                            .hold = table.hold,
                            .journal = config.journal_path(),
                            .requests = *std::move(requests)};
}

}  // namespace stepwright::missions
