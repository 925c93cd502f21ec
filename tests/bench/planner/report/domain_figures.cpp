#include "tests/bench/planner/report/domain_figures.h"

#include <algorithm>

namespace stepwright::bench {
namespace {

std::optional<double> median_of(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  return median(std::move(values));
}

std::optional<double> mean_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

Rival rival(const std::string& name, const std::vector<const Row*>& rows,
            const std::function<const Measurement&(const Row&)>& of) {
  Rival rival;
  rival.name = name;
  std::vector<double> times, time_ratios, cpu_ratios, cost_ratios;
  for (const Row* row : rows) {
    const Measurement& measured = of(*row);
    if (measured.outcome.empty() && !measured.solved()) continue;
    ++rival.instances;
    if (!measured.solved()) continue;
    ++rival.solved;
    times.push_back(measured.first().wall_ms);
    cost_ratios.push_back(row->ratio(measured.last().cost));
    if (row->ours.solved()) {
      time_ratios.push_back(measured.first().wall_ms / row->ours.first().wall_ms);
      cpu_ratios.push_back(measured.first().cpu_ms / std::max(0.1, row->ours.first().cpu_ms));
    } else {
      ++rival.lost;
    }
  }
  rival.first_plan_ms_median = median_of(times);
  rival.time_ratio_median = median_of(time_ratios);
  rival.cpu_ratio_median = median_of(cpu_ratios);
  rival.cost_ratio_to_best_known = mean_of(cost_ratios);
  return rival;
}

Quality quality_at(double time_s, const std::vector<const Row*>& rows) {
  Quality quality{time_s, 0, {}};
  std::vector<double> ratios;
  for (const Row* row : rows) {
    const Found* last = nullptr;
    for (const Found& found : row->ours.profile) {
      if (found.wall_ms <= 1000.0 * time_s) last = &found;
    }
    if (last == nullptr) continue;
    ++quality.solved;
    ratios.push_back(row->ratio(last->cost));
  }
  quality.cost_ratio = mean_of(ratios);
  return quality;
}

DomainFigures figures_of(const std::string& name, const Settings& settings,
                         const std::vector<const Row*>& rows) {
  DomainFigures figures;
  figures.name = name;
  std::vector<double> first_ms, first_ratios, ratios, grounding;
  for (const Row* row : rows) {
    ++figures.instances;
    if (row->ground.operators > 0) grounding.push_back(row->ground.grounding_ms);
    if (!row->ours.solved()) continue;
    ++figures.solved;
    figures.proved += row->ours.proved ? 1 : 0;
    first_ms.push_back(row->ours.first().wall_ms);
    first_ratios.push_back(row->ratio(row->ours.first().cost));
    ratios.push_back(row->ratio(row->ours.last().cost));
  }
  figures.first_plan_ms_median = median_of(first_ms);
  figures.first_cost_ratio = mean_of(first_ratios);
  figures.cost_ratio_to_best_known = mean_of(ratios);
  figures.grounding_ms_median = median_of(grounding);
  const double limit_s = static_cast<double>(settings.limits.time.count()) / 1000.0;
  for (double time_s = 0.01; time_s < limit_s; time_s *= 10.0) {
    figures.quality_over_time.push_back(quality_at(time_s, rows));
  }
  if (settings.baseline) {
    figures.rivals.push_back(
        rival("baseline", rows, [](const Row& row) -> const Measurement& { return row.baseline; }));
  }
  for (std::size_t i = 0; i < settings.outside.size(); ++i) {
    figures.rivals.push_back(rival(settings.outside[i].name, rows,
                                   [i](const Row& row) -> const Measurement& { return row.outside[i]; }));
  }
  return figures;
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::vector<DomainFigures> figures(const Settings& settings, const std::vector<Row>& rows) {
  std::vector<DomainFigures> all;
  std::vector<const Row*> every, domain;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    every.push_back(&rows[i]);
    domain.push_back(&rows[i]);
    const std::string& name = rows[i].instance.generator;
    if (i + 1 < rows.size() && rows[i + 1].instance.generator == name) continue;
    all.push_back(figures_of(name, settings, domain));
    domain.clear();
  }
  all.push_back(figures_of("all", settings, every));
  return all;
}

}  // namespace stepwright::bench
