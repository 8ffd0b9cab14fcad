#include "experiment/study/gauge_reliefs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "experiment/fits/attitude_regression.h"
#include "experiment/fits/gauge_relief.h"
#include "experiment/fits/point_relief.h"

namespace overt {

namespace {

using SettingsAt = std::map<std::string, std::vector<const GaugeSettingRow*>>; ///< by place

/// Names with numbers behind them in the order of these.
bool comes_before(const std::string& one, const std::string& other) {
    return one.size() != other.size() ? one.size() < other.size() : one < other;
}

glm::dvec3 position_of(const GaugeSettingRow& setting) { return {setting.x, setting.y, setting.z}; }

ReliefPointRow point_of(const ReliefOf& of, const std::vector<const GaugeSettingRow*>& settings) {
    ReliefPointRow point{.of = of, .point = settings.front()->point};
    point.settings = static_cast<int>(settings.size());
    glm::dvec3 sum(0.0);
    for (const GaugeSettingRow* setting : settings)
        sum += normal_of(setting->set);
    point.resultant = glm::length(sum) / static_cast<double>(settings.size());
    point.mean = attitude_of(sum);
    point.truth = settings.front()->truth;
    if (point.truth)
        point.deviation_deg = angle_between(point.mean, *point.truth).value;
    return point;
}

/// How ln D rises at a place with such a setting; the slant is cut off at the steepest.
ReliefSite site_of(const GaugeSettingRow& at, const Attitude& set, int& clipped) {
    Attitude attitude = set;
    if (attitude.slant.value > steepest_slant_deg) {
        attitude.slant.value = steepest_slant_deg;
        ++clipped;
    }
    const glm::dvec3 position = position_of(at);
    const glm::dvec3 normal = frame_of_sight(position) * normal_of(attitude);
    const glm::dvec3 sight = position / -position.z; // (u, v, -1)
    const double along = glm::dot(normal, sight);
    return {sight.x, sight.y, -normal.x / along, -normal.y / along};
}

/// Of the normals at a place about their mean, over all places with several: root mean square angle, with a
/// degree of freedom lost for each place.
std::optional<double> repeat_sd(const std::vector<ReliefPointRow>& points, const SettingsAt& settings) {
    double squares = 0.0;
    int freedom = 0;
    for (const ReliefPointRow& point : points) {
        const auto& of_point = settings.at(point.point);
        if (of_point.size() < 2)
            continue;
        for (const GaugeSettingRow* setting : of_point)
            squares += std::pow(angle_between(setting->set, point.mean).value, 2.0);
        freedom += static_cast<int>(of_point.size()) - 1;
    }
    return freedom > 0 ? std::optional(std::sqrt(squares / freedom)) : std::nullopt;
}

/// Settings that belong together, as they are drawn again: of one observer those at a place, of all those of
/// an observer.
std::vector<std::vector<AttitudePair>> attitude_groups(const ReliefOf& of,
                                                       const std::vector<const GaugeSettingRow*>& settings) {
    std::map<std::string, std::vector<AttitudePair>> groups;
    for (const GaugeSettingRow* setting : settings)
        if (setting->truth)
            groups[of.observer.empty() ? setting->of.observer : setting->point].push_back(
                {setting->set, *setting->truth});
    std::vector<std::vector<AttitudePair>> list;
    for (auto& [name, pairs] : groups)
        list.push_back(std::move(pairs));
    return list;
}

void regress(ReliefRow& row, const std::vector<std::vector<AttitudePair>>& groups,
             const BootstrapSettings& bootstrap) {
    const auto regressed = [&](std::span<const std::uint32_t> drawn) {
        std::vector<AttitudePair> pairs;
        for (const std::uint32_t group : drawn)
            pairs.insert(pairs.end(), groups[group].begin(), groups[group].end());
        return regress_attitudes(pairs);
    };
    std::vector<std::uint32_t> all(groups.size());
    std::iota(all.begin(), all.end(), 0U);
    const std::optional<AttitudeRegression> found = regressed(all);
    if (!found) {
        row.attitude_gain = Estimate::none("it needs three settings at places that lean differently");
        return;
    }
    row.attitude_gain =
        Estimate::of(found->gain, bootstrap_interval(
                                      static_cast<std::uint32_t>(groups.size()),
                                      [&](std::span<const std::uint32_t> drawn) -> std::optional<double> {
                                          const auto again = regressed(drawn);
                                          return again ? std::optional(again->gain) : std::nullopt;
                                      },
                                      bootstrap));
    row.attitude_x_shear = found->shear.x;
    row.attitude_y_shear = found->shear.y;
    row.attitude_r = found->r;
}

class ReliefMaking {
  public:
    ReliefMaking(const ReliefOf& of, const std::vector<const GaugeSettingRow*>& settings,
                 const BootstrapSettings& bootstrap) {
        row_.of = of;
        row_.settings = static_cast<int>(settings.size());
        double deviations = 0.0;
        int known = 0;
        for (const GaugeSettingRow* setting : settings) {
            at_[setting->point].push_back(setting);
            if (setting->truth) {
                deviations += angle_between(setting->set, *setting->truth).value;
                ++known;
            }
        }
        if (known > 0)
            row_.deviation_deg = deviations / known;
        for (const auto& [name, of_point] : at_)
            points_.push_back(point_of(of, of_point));
        std::ranges::sort(points_, comes_before, &ReliefPointRow::point);
        row_.points = static_cast<int>(points_.size());
        row_.repeat_sd_deg = repeat_sd(points_, at_);
        put_together();
        regress(row_, attitude_groups(of, settings), bootstrap);
    }
    void add_to(StudyReliefs& reliefs) {
        std::ranges::move(points_, std::back_inserter(reliefs.points));
        reliefs.reliefs.push_back(std::move(row_));
    }

  private:
    void put_together() {
        std::vector<ReliefSite> sites;
        std::vector<double> depths;
        for (const ReliefPointRow& point : points_) {
            const GaugeSettingRow& any = *at_.at(point.point).front();
            sites.push_back(site_of(any, point.mean, row_.clipped));
            depths.push_back(-any.z);
        }
        const double mean_depth = mean_of(depths);
        for (std::size_t i = 0; i < points_.size(); ++i) {
            points_[i].x = sites[i].x * mean_depth;
            points_[i].y = sites[i].y * mean_depth;
            points_[i].true_z = mean_depth - depths[i];
        }
        const std::optional<PointRelief> relief = point_relief(sites);
        if (!relief) {
            row_.note =
                points_.size() < 3 ? "a relief needs three places at least" : "the places lie on one line";
            return;
        }
        row_.edges = static_cast<int>(relief->edges.size());
        row_.residual = relief->residual_rms * mean_depth;
        std::vector<double> found;
        for (const double log_depth : relief->height)
            found.push_back(std::exp(log_depth));
        const double factor = mean_depth / mean_of(found);
        for (double& depth : found)
            depth *= factor;
        for (std::size_t i = 0; i < points_.size(); ++i)
            points_[i].z = mean_depth - found[i];
        compare();
    }

    void compare() {
        std::vector<ReliefNode> nodes;
        std::vector<double> z, true_z;
        for (const ReliefPointRow& point : points_) {
            nodes.push_back({point.x, point.y});
            z.push_back(*point.z);
            true_z.push_back(point.true_z);
        }
        const std::optional<ReliefAgreement> agreement = compare_relief(nodes, z, true_z);
        if (!agreement) {
            row_.note = "a comparison with the surface needs five places at least";
            return;
        }
        row_.gain = agreement->gain;
        row_.r = std::copysign(std::sqrt(std::max(0.0, agreement->r_squared)), agreement->gain);
        row_.affine_gain = agreement->affine_gain;
        row_.x_shear = agreement->x_shear;
        row_.y_shear = agreement->y_shear;
        row_.affine_r = std::sqrt(std::max(0.0, agreement->affine_r_squared));
    }

    static double mean_of(const std::vector<double>& values) {
        double sum = 0.0;
        for (const double value : values)
            sum += value;
        return sum / static_cast<double>(values.size());
    }

    SettingsAt at_;
    std::vector<ReliefPointRow> points_;
    ReliefRow row_;
};

} // namespace

std::string picture_in_words(const ReliefOf& of, const std::vector<ReliefRow>& all) {
    std::string words = of.object;
    const auto add = [&](const auto& member, const char* name) {
        if (std::ranges::any_of(all, [&](const ReliefRow& row) { return row.of.*member != of.*member; }))
            words += fmt::format(", {} {}", name, of.*member);
    };
    add(&ReliefOf::material, "material");
    add(&ReliefOf::light, "light");
    add(&ReliefOf::motion, "motion");
    add(&ReliefOf::view, "view");
    add(&ReliefOf::frame, "frame");
    return words;
}

void reckon_reliefs(StudyReliefs& reliefs, const BootstrapSettings& bootstrap) {
    std::map<ReliefOf, std::vector<const GaugeSettingRow*>> groups;
    std::map<ReliefOf, std::set<std::string>> observers;
    for (const GaugeSettingRow& setting : reliefs.settings) {
        groups[setting.of].push_back(&setting);
        ReliefOf all = setting.of;
        all.observer.clear();
        groups[all].push_back(&setting);
        observers[all].insert(setting.of.observer);
    }
    for (const auto& [of, settings] : groups)
        if (!of.observer.empty() || observers[of].size() > 1)
            ReliefMaking(of, settings, bootstrap).add_to(reliefs);
}

} // namespace overt
