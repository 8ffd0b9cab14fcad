#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "experiment/report/packed_array.h"
#include "experiment/report/report_page.h"
#include "experiment/surface/coarse_surface.h"
#include "experiment/surface/colour_scale.h"

namespace overt {
namespace {

using Json = nlohmann::ordered_json;

/// Traces in the page: enough to see a saccade.
constexpr double most_trace_hz = 125.0;
/// Bytes of all maps together, before base64; with more maps their meshes become coarser.
constexpr std::size_t most_map_bytes = 10'000'000;
constexpr std::size_t least_report_vertices = 4000;

// So many digits as a reader may want; JSON has no number that is not finite.
Json number(double value, int digits = 6) {
    if (!std::isfinite(value))
        return nullptr;
    if (value == 0.0)
        return 0;
    const double scale = std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(value))));
    const double rounded = std::round(value * scale) / scale;
    return std::isfinite(rounded) ? Json(rounded) : Json(value);
}
Json number(const std::optional<double>& value, int digits = 6) {
    return value ? number(*value, digits) : Json(nullptr);
}

Json json_of(const Estimate& estimate) {
    Json json{{"v", number(estimate.value)}};
    if (estimate.interval) {
        json["lo"] = number(estimate.interval->low);
        json["hi"] = number(estimate.interval->high);
    }
    if (!estimate.absent.empty())
        json["absent"] = estimate.absent;
    return json;
}

Json json_of(const std::vector<StudyKey>& keys) {
    Json json = Json::array();
    for (const StudyKey& key : keys)
        json.push_back({key.column, key.value});
    return json;
}

Json json_of(const SimilarityEstimate& similarity) {
    return {{"value", json_of(similarity.value)},
            {"ceiling", json_of(similarity.ceiling)},
            {"null", json_of(similarity.null)},
            {"p", number(similarity.p)}};
}

Json json_of(const StudyQuality& q) {
    return {{"accuracy", number(q.accuracy_deg)},
            {"worst", number(q.worst_accuracy_deg)},
            {"drift", number(q.drift_deg)},
            {"rms", number(q.rms_s2s_deg)},
            {"sd", number(q.sd_deg)},
            {"rate", number(q.rate_hz, 7)},
            {"samples", q.samples},
            {"lost", number(q.lost_share())},
            {"blinked", number(q.blink_share())},
            {"blinks", q.blinks},
            {"refreshes", q.refreshes},
            {"missed", q.missed_refreshes ? Json(*q.missed_refreshes) : Json("unproven")},
            {"off_plan", number(q.off_plan)}};
}

Json json_of(const glm::dvec3& v) { return {number(v.x, 8), number(v.y, 8), number(v.z, 8)}; }

double highest_of(const std::vector<float>& values) {
    return values.empty() ? 0.0 : static_cast<double>(*std::max_element(values.begin(), values.end()));
}

/// The mesh that the page shows of a sculpture.
// NOLINTNEXTLINE(bugprone-exception-escape): JSON that is moved throws nothing
struct ShownMesh {
    std::vector<std::uint32_t> vertices; ///< of the study's mesh
    Json json;
};

ShownMesh shown_mesh(const StudySculpture& sculpture, std::size_t most_vertices) {
    ShownMesh shown;
    if (!sculpture.mesh || sculpture.mesh->triangles.empty())
        return shown;
    const Mesh& mesh = *sculpture.mesh;
    const SurfaceGeometry geometry(mesh);
    const CoarseSurface coarse(geometry, most_vertices);
    std::vector<std::uint32_t> vertex_of_node(geometry.node_count(), 0);
    for (auto v = static_cast<std::uint32_t>(mesh.positions.size()); v-- > 0;)
        vertex_of_node[geometry.node_of(v)] = v;
    for (std::uint32_t v = 0; v < coarse.vertex_count(); ++v)
        shown.vertices.push_back(vertex_of_node[coarse.fine_node_of(v)]);
    // 16 bits between the bounds of the box.
    const Bounds bounds = mesh.bounds();
    std::vector<std::uint16_t> positions;
    for (const std::uint32_t v : shown.vertices) {
        for (int axis = 0; axis < 3; ++axis) {
            const double extent = bounds.extent()[axis];
            const double share =
                extent > 0.0 ? (static_cast<double>(mesh.positions[v][axis]) - bounds.min[axis]) / extent
                             : 0.0;
            positions.push_back(
                static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0))));
        }
    }
    std::vector<std::uint32_t> triangles;
    for (const glm::uvec3& t : coarse.mesh().triangles)
        triangles.insert(triangles.end(), {t.x, t.y, t.z});
    const bool is_small = shown.vertices.size() <= 65535;
    const std::vector<std::uint16_t> small_triangles(triangles.begin(),
                                                     is_small ? triangles.end() : triangles.begin());
    std::vector<std::uint8_t> visible;
    for (const std::uint32_t v : shown.vertices)
        visible.push_back(v < sculpture.seconds_visible.size() && sculpture.seconds_visible[v] <= 0.0f ? 0
                                                                                                       : 1);
    shown.json = {{"vertices", shown.vertices.size()},
                  {"of", mesh.positions.size()},
                  {"low", json_of(bounds.min)},
                  {"high", json_of(bounds.max)},
                  {"positions", packed(positions)},
                  {"wide", !is_small},
                  {"triangles", is_small ? packed(small_triangles) : packed(triangles)},
                  {"visible", packed(visible)}};
    return shown;
}

// Values at the shown vertices as bytes from 0 to `most`.
std::string bytes_of(const std::vector<float>& values, const ShownMesh& shown, double most) {
    std::vector<std::uint8_t> bytes;
    for (const std::uint32_t v : shown.vertices)
        bytes.push_back(static_cast<std::uint8_t>(
            std::lround(255.0 * std::clamp(most > 0.0 ? values[v] / most : 0.0, 0.0, 1.0))));
    return packed(bytes);
}

std::string signed_bytes_of(const std::vector<float>& values, const ShownMesh& shown, double most) {
    std::vector<std::int8_t> bytes;
    for (const std::uint32_t v : shown.vertices)
        bytes.push_back(static_cast<std::int8_t>(
            std::lround(127.0 * std::clamp(most > 0.0 ? values[v] / most : 0.0, -1.0, 1.0))));
    return packed(bytes);
}

Json json_of_maps(const StudyResults& results, const std::vector<ShownMesh>& shown) {
    Json maps = Json::array();
    for (const StudyMap& map : results.maps) {
        const ShownMesh& mesh = shown[static_cast<std::size_t>(map.sculpture)];
        Json json{{"group", map.group},
                  {"sculpture", map.sculpture},
                  {"by", map.weighting == MapWeighting::duration ? "duration" : "count"},
                  {"peak", number(map.peak)},
                  {"mean", number(map.mean)},
                  {"total", number(map.total)},
                  {"observers", map.observers},
                  {"trials", map.trials},
                  {"fixations", map.fixations},
                  {"sigma", {number(map.least_sigma_mm, 4), number(map.most_sigma_mm, 4)}},
                  {"leak", number(map.euclidean_leak, 4)},
                  {"error",
                   {{"accuracy", number(map.error.accuracy_mm, 4)},
                    {"precision", number(map.error.precision_mm, 4)},
                    {"timing", number(map.error.timing_mm, 4)},
                    {"lut", number(map.error.lut_mm, 4)},
                    {"together", number(map.error.together_mm, 4)},
                    {"at_edge", number(map.error.at_edge, 4)},
                    {"near_edge", number(map.error.near_edge, 4)}}}};
        if (!map.density.empty() && !mesh.vertices.empty())
            json["values"] = bytes_of(map.density, mesh, map.peak);
        else
            json["absent"] = map.absent;
        maps.push_back(std::move(json));
    }
    return maps;
}

Json json_of_differences(const StudyResults& results, const std::vector<ShownMesh>& shown) {
    Json differences = Json::array();
    for (const DifferenceMap& map : results.differences) {
        const ShownMesh& mesh = shown[static_cast<std::size_t>(map.sculpture)];
        double most = 0.0;
        for (const float value : map.difference)
            most = std::max(most, std::abs(static_cast<double>(value)));
        Json clusters = Json::array();
        for (const DifferenceMap::Cluster& cluster : map.clusters)
            clusters.push_back(
                {{"area", number(cluster.area_mm2)},
                 {"mass", number(cluster.mass)},
                 {"difference", number(cluster.difference, 4)},
                 {"centre", json_of(cluster.centroid_mm)},
                 {"part", cluster.part ? Json(static_cast<int>(*cluster.part)) : Json(nullptr)},
                 {"p", number(cluster.p)},
                 {"p_all", number(cluster.p_of_all)}});
        Json json{{"keys", json_of(map.keys)},
                  {"sculpture", map.sculpture},
                  {"column", map.column},
                  {"a", map.a},
                  {"b", map.b},
                  {"most", number(most)},
                  {"threshold", number(map.threshold_t)},
                  {"least_p", number(map.least_p)},
                  {"observers", map.observers},
                  {"clusters", clusters}};
        if (!map.difference.empty() && !mesh.vertices.empty()) {
            json["values"] = signed_bytes_of(map.difference, mesh, most);
            std::vector<std::uint8_t> numbers;
            for (const std::uint32_t v : mesh.vertices)
                numbers.push_back(v < map.cluster.size()
                                      ? static_cast<std::uint8_t>(std::min<int>(map.cluster[v], 255))
                                      : 0);
            json["cluster"] = packed(numbers);
        } else {
            json["absent"] = map.absent;
        }
        differences.push_back(std::move(json));
    }
    return differences;
}

Json json_of_trials(const StudyResults& results) {
    Json trials = Json::array();
    for (const StudyTrial& trial : results.trials) {
        std::vector<float> times, angles;
        for (const StudyTurn& turn : trial.turns) {
            times.push_back(static_cast<float>(turn.time_s));
            angles.push_back(static_cast<float>(turn.angle_deg));
        }
        Json fixations = Json::array();
        for (std::size_t i = trial.first_fixation; i < trial.first_fixation + trial.fixations; ++i) {
            const StudyFixation& f = results.fixations[i];
            Json position = nullptr;
            if (f.triangle)
                position = {number(f.position.x, 5), number(f.position.y, 5), number(f.position.z, 5)};
            fixations.push_back({number(f.onset_s, 5), number(f.duration_s, 4), number(f.place.x_px, 5),
                                 number(f.place.y_px, 5), position, f.counted() ? 1 : 0,
                                 std::string(name_of(f.why)),
                                 f.part ? Json(static_cast<int>(*f.part)) : Json(nullptr)});
        }
        trials.push_back({{"label", trial.label},
                          {"session", trial.session},
                          {"sculpture", trial.sculpture},
                          {"number", trial.number},
                          {"keys", json_of(trial.keys)},
                          {"seconds", number(trial.presentation_s)},
                          {"excluded", trial.excluded ? trial.why_excluded : std::string()},
                          {"times", packed(times)},
                          {"angles", packed(angles)},
                          {"fixations", std::move(fixations)},
                          {"quality", json_of(trial.quality)}});
    }
    return trials;
}

// Tenths of pixels; -32768 where the eye was lost. Time in ten-thousandths of a second, pupil in the
// tracker's unit over 65535 of its largest.
Json json_of_traces(const StudyResults& results) {
    constexpr std::int16_t lost = -32768;
    Json traces = Json::array();
    for (const StudyTrace& trace : results.traces) {
        std::vector<std::int32_t> times;
        std::vector<std::int16_t> places;
        std::vector<std::uint16_t> pupils;
        float widest = 0.0f;
        for (const StudyTracePoint& point : trace.points)
            widest = std::max(widest, point.pupil);
        double next = -1e9;
        const auto tenths = [](double px) {
            return static_cast<std::int16_t>(std::lround(std::clamp(10.0 * px, -32767.0, 32767.0)));
        };
        for (const StudyTracePoint& point : trace.points) {
            if (point.time_s < next)
                continue;
            next = point.time_s + (1.0 - 1e-3) / most_trace_hz;
            times.push_back(static_cast<std::int32_t>(std::lround(1e4 * point.time_s)));
            places.push_back(point.gaze ? tenths(point.gaze->x_px) : lost);
            places.push_back(point.gaze ? tenths(point.gaze->y_px) : lost);
            pupils.push_back(static_cast<std::uint16_t>(
                std::lround(widest > 0.0f ? 65535.0f * std::max(0.0f, point.pupil) / widest : 0.0f)));
        }
        Json events = Json::array();
        for (const StudyTraceEvent& event : trace.events) {
            const char* kind = event.kind == GazeEvent::Kind::fixation  ? "f"
                               : event.kind == GazeEvent::Kind::saccade ? "s"
                                                                        : "b";
            events.push_back({kind, number(event.onset_s, 5), number(event.duration_s, 4)});
        }
        traces.push_back({{"trial", trace.trial},
                          {"times", packed(times)},
                          {"places", packed(places)},
                          {"pupils", packed(pupils)},
                          {"widest", number(widest)},
                          {"events", events}});
    }
    return traces;
}

Json json_of_tables(const StudyResults& results) {
    Json heads = Json::array(), distributions = Json::array(), pairs = Json::array(), effects = Json::array(),
         motions = Json::array(), lights = Json::array(), predictions = Json::array(),
         reliabilities = Json::array(), exposures = Json::array(), course = Json::array();
    for (const HeadFractionRow& row : results.head_fractions) {
        Json json{{"keys", json_of(row.keys)},
                  {"count", json_of(row.by_count)},
                  {"duration", json_of(row.by_duration)},
                  {"corrected", json_of(row.corrected)},
                  {"pooled", number(row.pooled)},
                  {"each", Json::array()},
                  {"observers", row.observers},
                  {"trials", row.trials},
                  {"fixations", row.fixations}};
        for (const double share : row.of_observers)
            json["each"].push_back(number(share, 4));
        if (row.pooled_interval)
            json["pooled_ci"] = {number(row.pooled_interval->low), number(row.pooled_interval->high)};
        heads.push_back(std::move(json));
    }
    for (const DistributionRow& row : results.distributions) {
        Json variance = Json::array(), variance_deg = Json::array();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            variance.push_back(number(row.variance_mm2[axis]));
            variance_deg.push_back(number(row.variance_deg2[axis]));
        }
        distributions.push_back({{"group", row.group},
                                 {"sculpture", row.sculpture},
                                 {"wss", json_of(row.wss_mm2)},
                                 {"wss_deg", json_of(row.wss_deg2)},
                                 {"variance", variance},
                                 {"variance_deg", variance_deg},
                                 {"peak", number(row.map_peak)},
                                 {"mean", number(row.map_mean)},
                                 {"observers", row.observers},
                                 {"fixations", row.fixations}});
    }
    for (const PairRow& row : results.pairs)
        pairs.push_back({{"keys", json_of(row.keys)},
                         {"column", row.column},
                         {"a", row.a},
                         {"b", row.b},
                         {"wss", json_of(row.wss_difference_mm2)},
                         {"wss_deg", json_of(row.wss_difference_deg2)},
                         {"p", number(row.wss_p)},
                         {"holm", number(row.wss_p_holm)},
                         {"cc", json_of(row.cc)},
                         {"sim", json_of(row.sim_mit)},
                         {"sim_plain", json_of(row.sim_pysaliency)},
                         {"observers", row.observers},
                         {"comparisons", row.comparisons},
                         {"absent", row.absent}});
    for (const FactorEffectRow& row : results.effects)
        effects.push_back({{"measure", row.measure},
                           {"effect", row.effect},
                           {"p", number(row.p)},
                           {"holm", number(row.p_holm)},
                           {"least", number(row.least_p)},
                           {"observers", row.observers},
                           {"absent", row.absent}});
    for (const GazeMotionRow& row : results.motions)
        motions.push_back({{"keys", json_of(row.keys)},
                           {"gain", json_of(row.surface_gain)},
                           {"speed", json_of(row.surface_speed_deg_s)},
                           {"observers", row.observers},
                           {"fixations", row.fixations}});
    for (const LightAtGazeRow& row : results.lights)
        lights.push_back({{"keys", json_of(row.keys)},
                          {"met", json_of(row.lightness)},
                          {"place", json_of(row.over_place)},
                          {"point", json_of(row.over_point)},
                          {"observers", row.observers},
                          {"fixations", row.fixations}});
    for (const MapPredictionRow& row : results.predictions)
        predictions.push_back({{"group", row.group},
                               {"sculpture", row.sculpture},
                               {"by", name_of(row.by)},
                               {"level", row.level},
                               {"kl", json_of(row.kl)},
                               {"nss", json_of(row.nss)},
                               {"auc", json_of(row.auc_judd)},
                               {"borji", json_of(row.auc_borji)},
                               {"gain", json_of(row.gain_over_exposure)},
                               {"gain_area", json_of(row.gain_over_area)},
                               {"observers", row.observers}});
    for (const MapReliabilityRow& row : results.reliabilities)
        reliabilities.push_back({{"keys", json_of(row.keys)},
                                 {"sculpture", row.sculpture},
                                 {"split", json_of(row.split_half_cc)},
                                 {"reliability", json_of(row.reliability)},
                                 {"observers", row.observers},
                                 {"fixations", row.fixations}});
    for (const ExposureRow& row : results.exposures)
        exposures.push_back({{"sculpture", row.sculpture},
                             {"part", row.part},
                             {"area", number(row.area_mm2)},
                             {"share_of_area", number(row.share_of_area, 4)},
                             {"never", number(row.never_visible, 4)},
                             {"seconds", number(row.seconds_visible, 4)},
                             {"share", number(row.share_of_exposure, 4)},
                             {"foreshortening", number(row.foreshortening, 4)},
                             {"fixations", number(row.share_of_fixations, 4)}});
    for (const TimeCourseRow& row : results.time_course)
        course.push_back({{"key", {row.key.column, row.key.value}},
                          {"from", row.from_s},
                          {"to", row.to_s},
                          {"head", json_of(row.head_fraction)},
                          {"observers", row.observers}});
    return {{"heads", heads},
            {"distributions", distributions},
            {"pairs", pairs},
            {"effects", effects},
            {"motions", motions},
            {"lights", lights},
            {"predictions", predictions},
            {"reliabilities", reliabilities},
            {"exposures", exposures},
            {"course", course}};
}

} // namespace

nlohmann::ordered_json report_data(const StudyResults& results) {
    const std::size_t maps = results.maps.size() + results.differences.size();
    const std::size_t vertices = std::clamp(most_map_bytes / std::max<std::size_t>(1, maps),
                                            least_report_vertices, most_report_vertices);
    Json sculptures = Json::array();
    std::vector<ShownMesh> shown;
    for (const StudySculpture& sculpture : results.sculptures) {
        shown.push_back(shown_mesh(sculpture, vertices));
        sculptures.push_back(
            {{"id", sculpture.id},
             {"title", sculpture.title},
             {"parts", sculpture.part_names},
             {"camera", json_of(sculpture.camera.position)},
             {"target", json_of(sculpture.camera.target)},
             {"fov", sculpture.camera.vertical_fov.value},
             {"axis", json_of(sculpture.axis_point)},
             {"screen", {sculpture.screen.screen_px.x, sculpture.screen.screen_px.y}},
             {"origin", {sculpture.screen.image_origin_px.x, sculpture.screen.image_origin_px.y}},
             {"image", {sculpture.screen.image_px.x, sculpture.screen.image_px.y}},
             {"px_per_deg", number(sculpture.screen.px_per_deg_at_centre())},
             {"mm_per_unit", number(sculpture.mm_per_unit)},
             {"remark", sculpture.remark},
             {"mesh", shown.back().json}});
        const ShownMesh& mesh = shown.back();
        const std::size_t vertex_count = sculpture.mesh ? sculpture.mesh->positions.size() : 0;
        if (mesh.vertices.empty())
            continue;
        if (sculpture.exposure_density.size() == vertex_count) {
            const double most = highest_of(sculpture.exposure_density);
            sculptures.back()["exposure"] = {{"most", number(most)},
                                             {"values", bytes_of(sculpture.exposure_density, mesh, most)}};
        }
        if (sculpture.seconds_visible.size() == vertex_count) {
            const double most = highest_of(sculpture.seconds_visible);
            sculptures.back()["seconds"] = {{"most", number(most)},
                                            {"values", bytes_of(sculpture.seconds_visible, mesh, most)}};
        }
    }
    Json sessions = Json::array(), parameters = Json::array(), groups = Json::array(),
         not_counted = Json::array();
    for (const StudySession& s : results.sessions)
        sessions.push_back({{"folder", s.folder},
                            {"observer", s.observer},
                            {"number", s.number},
                            {"protocol", s.protocol},
                            {"tracker", s.tracker},
                            {"simulated", s.is_simulated},
                            {"form", json_of(s.form)},
                            {"events", s.events},
                            {"complete", s.is_complete},
                            {"trials", s.trials}});
    for (const StudyParameter& p : results.parameters)
        parameters.push_back({p.name, p.value, p.unit, p.meaning});
    for (const StudyGroup& g : results.groups)
        groups.push_back({{"keys", json_of(g.keys)},
                          {"observers", g.observers},
                          {"trials", g.trials.size()},
                          {"fixations", g.fixations}});
    for (const auto& [why, count] : results.glance.not_counted)
        not_counted.push_back({std::string(name_of(why)), count});
    Json quality = Json::array();
    for (const StudyQuality& q : results.session_quality)
        quality.push_back(json_of(q));
    Json reporting = Json::array();
    for (const ReportingItem& item : results.reporting)
        reporting.push_back({item.topic, item.item, item.value, item.is_recorded});
    Json colours = Json::object();
    for (const ColourMap map : {ColourMap::viridis, ColourMap::cividis, ColourMap::coolwarm}) {
        std::vector<std::uint8_t> bytes;
        for (const auto& colour : colour_table(map))
            bytes.insert(bytes.end(), colour.begin(), colour.end());
        colours[std::string(name_of(map))] = packed(bytes);
    }
    const StudyGlance& glance = results.glance;
    return {{"glance",
             {{"title", glance.title},
              {"observers", glance.observers},
              {"sessions", glance.sessions},
              {"trials", glance.trials},
              {"excluded", glance.excluded_trials},
              {"samples", glance.samples},
              {"fixations", glance.fixations},
              {"counted", glance.counted},
              {"not_counted", not_counted},
              {"seconds", number(glance.counted_s)},
              {"simulated", glance.any_simulated}}},
            {"parameters", parameters},
            {"remarks", results.remarks},
            {"by", results.by},
            {"confidence", results.confidence},
            {"colours", colours},
            {"sessions", sessions},
            {"session_quality", quality},
            {"reporting", reporting},
            {"sculptures", sculptures},
            {"groups", groups},
            {"maps", json_of_maps(results, shown)},
            {"differences", json_of_differences(results, shown)},
            {"tables", json_of_tables(results)},
            {"trials", json_of_trials(results)},
            {"traces", json_of_traces(results)}};
}

} // namespace overt
