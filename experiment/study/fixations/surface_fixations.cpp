#include "experiment/study/fixations/surface_fixations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "experiment/maps/coordinate_maps.h"

namespace overt {

namespace {

/// Of the sum of two shares.
constexpr double rounding = 1e-12;

/// The sample whose place is nearest to the one in space with the least sum of distances to all: Weiszfeld's
/// steps.
const PlacedSample& median_in_space(std::span<const PlacedSample* const> placed) {
    glm::dvec3 median{0.0};
    for (const PlacedSample* sample : placed)
        median += sample->surface.position;
    median /= static_cast<double>(placed.size());
    const double least = 1e-6 * glm::length(placed.front()->surface.position - median) + 1e-12;
    for (int step = 0; step < 20; ++step) {
        glm::dvec3 sum{0.0};
        double weights = 0.0;
        for (const PlacedSample* sample : placed) {
            const double weight = 1.0 / std::max(glm::distance(sample->surface.position, median), least);
            sum += weight * sample->surface.position;
            weights += weight;
        }
        median = sum / weights;
    }
    return **std::min_element(
        placed.begin(), placed.end(), [&](const PlacedSample* a, const PlacedSample* b) {
            return glm::distance(a->surface.position, median) < glm::distance(b->surface.position, median);
        });
}

/// The same along the surface. Ways on a coarser surface do: what counts is on which sheet the place is.
const PlacedSample& median_along_surface(std::span<const PlacedSample* const> placed, SurfaceWays& ways) {
    std::vector<const SurfacePoint*> points;
    for (const PlacedSample* sample : placed)
        points.push_back(&sample->surface);
    std::vector<const PlacedSample*> nearest;
    for (const std::size_t index : ways.nearest_to_all(points))
        nearest.push_back(placed[index]);
    return median_in_space(nearest);
}

/// Where the fixation's samples have their places on the surface. Samples come at equal steps of time, so
/// that equal weights are weights of duration. Where all are about equally deep they lie on one sheet, on
/// which straight distances do for those along the surface.
void find_point(StudyFixation& fixation, std::span<const PlacedSample* const> placed,
                const FixationContext& context) {
    const PlacedSample* median = &median_in_space(placed);
    if (context.scale)
        fixation.sigma_mm = sigma_mm(context.options.sigma, *context.scale, median->surface.depth);
    if (context.ways && context.scale) {
        const auto [least, most] = std::minmax_element(
            placed.begin(), placed.end(),
            [](const PlacedSample* a, const PlacedSample* b) { return a->surface.depth < b->surface.depth; });
        const double range_mm =
            ((*most)->surface.depth - (*least)->surface.depth) * context.scale->mm_per_unit;
        if (range_mm > 0.5 * fixation.sigma_mm) {
            median = &median_along_surface(placed, *context.ways);
            fixation.sigma_mm = sigma_mm(context.options.sigma, *context.scale, median->surface.depth);
        }
    }
    fixation.position = median->surface.position;
    if (context.scale)
        fixation.mm_per_deg = context.scale->mm_per_deg * median->surface.depth / context.scale->axis_depth;
    if (context.has_mesh) {
        fixation.triangle = median->surface.triangle;
        fixation.barycentric = glm::max(median->surface.barycentric, glm::dvec3(0.0));
        fixation.barycentric /= fixation.barycentric.x + fixation.barycentric.y + fixation.barycentric.z;
    }
}

void find_part(StudyFixation& fixation, std::span<const PlacedSample* const> placed) {
    std::array<int, 256> counts{};
    for (const PlacedSample* sample : placed)
        ++counts[sample->surface.part];
    fixation.part = static_cast<PartIndex>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

void find_spread(StudyFixation& fixation, std::span<const PlacedSample* const> placed,
                 const ObjectScale& scale) {
    double squares = 0.0, depth = 0.0;
    for (const PlacedSample* sample : placed) {
        const glm::dvec3 off = sample->surface.position - fixation.position;
        squares += glm::dot(off, off);
        depth += sample->surface.depth;
    }
    const auto count = static_cast<double>(placed.size());
    fixation.spread_mm = std::sqrt(squares / count) * scale.mm_per_unit;
    fixation.spread_deg = *fixation.spread_mm / (scale.mm_per_deg * depth / count / scale.axis_depth);
}

/// Where else a gaze cone around the fixation's middle sample lands: its share beside the object, or on a
/// sheet of surface whose depth differs by more than the kernel's sigma, and how far the rest scatters.
void find_cone(StudyFixation& fixation, const PlacedSample& middle, const FixationContext& context) {
    double same_sheet = 0.0, squares = 0.0;
    const double limit = std::max(fixation.sigma_mm / context.scale->mm_per_unit, 1e-12);
    for (const WeightedSurfacePoint& place :
         context.cone->on_surface(*context.lookup, middle.pose, middle.gaze)) {
        if (std::abs(place.point.depth - middle.surface.depth) > limit)
            continue;
        const glm::dvec3 off = place.point.position - middle.surface.position;
        same_sheet += place.weight;
        squares += place.weight * glm::dot(off, off);
    }
    fixation.cone_at_edge = std::clamp(1.0 - same_sheet, 0.0, 1.0);
    if (same_sheet > 0.0)
        fixation.cone_mm = std::sqrt(squares / same_sheet) * context.scale->mm_per_unit;
}

/// How far the point that the map gave for a sample lies from its line of sight, which it should be on.
std::optional<double> lut_error_mm(const PlacedSample& sample, const FixationContext& context) {
    const auto* maps = dynamic_cast<const CoordinateMaps*>(context.lookup);
    if (!maps || !context.screen || !sample.is_on_surface)
        return std::nullopt;
    const SightLines& lines = maps->sight_lines(sample.pose);
    const glm::dvec3 seen = lines.project(sample.surface.position);
    const double off_px = glm::distance(glm::dvec2(seen), context.screen->image_from_screen(sample.gaze));
    return off_px * lines.pixel_width_at(seen.z) * context.scale->mm_per_unit;
}

/// Where a point of the surface is seen by each of some samples, less the mean, in degrees.
std::vector<glm::dvec2> way_on_screen(const glm::dvec3& point, std::span<const PlacedSample* const> lit,
                                      const CoordinateMaps& maps, double deg_per_px) {
    std::vector<glm::dvec2> way;
    PoseIndex pose{-1};
    glm::dvec2 mean{0.0};
    for (const PlacedSample* sample : lit) {
        if (way.empty() || sample->pose != pose) {
            pose = sample->pose;
            way.push_back(glm::dvec2(maps.sight_lines(pose).project(point)) * deg_per_px);
        } else {
            way.push_back(way.back());
        }
        mean += way.back() / static_cast<double>(lit.size());
    }
    for (glm::dvec2& place : way)
        place -= mean;
    return way;
}

/// The mean of the products of two ways.
double mean_product(std::span<const glm::dvec2> a, std::span<const glm::dvec2> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += glm::dot(a[i], b[i]);
    return sum / static_cast<double>(a.size());
}

/// The same for points as far from the fixation's as the tracker's error puts it from what was looked at.
void find_displaced_motion(StudyFixation& fixation, std::span<const PlacedSample* const> lit,
                           std::span<const glm::dvec2> gaze, const PlacedSample& middle,
                           const FixationContext& context, const CoordinateMaps& maps, double deg_per_px) {
    double weights = 0.0, products = 0.0, squares = 0.0;
    for (const WeightedSurfacePoint& one :
         context.cone->on_surface(*context.lookup, middle.pose, middle.gaze)) {
        const std::vector<glm::dvec2> way = way_on_screen(one.point.position, lit, maps, deg_per_px);
        weights += one.weight;
        products += one.weight * mean_product(gaze, way);
        squares += one.weight * mean_product(way, way);
    }
    if (weights > 0.0)
        fixation.displaced_motion = StudyFixation::DisplacedMotion{products / weights, squares / weights};
}

/// How gaze and the fixation's point of the surface move on the screen: see StudyFixation.
void find_motion(StudyFixation& fixation, std::span<const PlacedSample* const> lit,
                 const PlacedSample& middle, const FixationContext& context) {
    const auto* maps = dynamic_cast<const CoordinateMaps*>(context.lookup);
    if (!maps || !context.screen || lit.size() < 2)
        return;
    const double deg_per_px = 1.0 / context.screen->px_per_deg_at_centre();
    const std::vector<glm::dvec2> points = way_on_screen(fixation.position, lit, *maps, deg_per_px);
    std::vector<glm::dvec2> gaze;
    glm::dvec2 mean{0.0};
    for (const PlacedSample* sample : lit) {
        gaze.push_back(glm::dvec2(sample->gaze.x_px, sample->gaze.y_px) * deg_per_px);
        mean += gaze.back() / static_cast<double>(lit.size());
    }
    for (glm::dvec2& place : gaze)
        place -= mean;
    fixation.gaze_with_surface_deg2 = mean_product(gaze, points);
    fixation.surface_way_deg2 = mean_product(points, points);
    double way_deg = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i)
        way_deg += glm::distance(points[i], points[i - 1]);
    if (fixation.duration_s > 0.0)
        fixation.surface_deg_s = way_deg / fixation.duration_s;
    if (context.cone && context.is_accuracy_known)
        find_displaced_motion(fixation, lit, gaze, middle, context, *maps, deg_per_px);
}

/// A picture's score, and how much it counts beside the time that it is shown.
struct WeightedScore {
    double score = 0.0, weight = 1.0;
};

/// The mean over the motion of what a picture gives, each for as long as a presentation shows it.
template <class ScoreOf>
std::optional<double> mean_over_pictures(const ShownPictures& pictures, const ScoreOf& score_of) {
    double sum = 0.0, weights = 0.0;
    for (std::size_t picture = 0; picture < pictures.seconds.size(); ++picture) {
        if (!(pictures.seconds[picture] > 0.0))
            continue;
        if (const std::optional<WeightedScore> of = score_of(static_cast<int>(picture))) {
            sum += pictures.seconds[picture] * of->weight * of->score;
            weights += pictures.seconds[picture] * of->weight;
        }
    }
    return weights > 0.0 ? std::optional(sum / weights) : std::nullopt;
}

/// How much of a picture a piece of the surface about a point fills, of the same area in each pose: the
/// cosine of the angle of view over the square of the distance.
double size_in_picture(const SightLines& lines, const glm::dvec3& point, const glm::dvec3& normal) {
    const glm::dvec3 way = lines.origin() - point;
    const double distance = glm::length(way);
    return std::abs(glm::dot(normal, way)) / (distance * distance * distance);
}

/// The normal of the triangle that a fixation's place is on.
glm::dvec3 normal_at(const glm::dvec3& place, std::span<const PlacedSample* const> placed, const Mesh& mesh) {
    const auto nearest = std::ranges::min_element(placed, {}, [&](const PlacedSample* sample) {
        const glm::dvec3 off = sample->surface.position - place;
        return glm::dot(off, off);
    });
    const glm::uvec3 corners = mesh.triangles[(*nearest)->surface.triangle];
    const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3(0.0);
}

/// How bright what gaze met was, and how bright the same place of the screen and the same point of the
/// surface are at other times: see FixationLight.
void find_light(StudyFixation& fixation, std::span<const PlacedSample* const> placed,
                const FixationContext& context) {
    const auto* maps = dynamic_cast<const CoordinateMaps*>(context.lookup);
    if (!maps || !context.screen || !context.light || !context.pictures)
        return;
    const ShownPictures& pictures = *context.pictures;
    double sum = 0.0;
    int met = 0;
    for (const PlacedSample* sample : placed) {
        if (!sample->is_on_surface)
            continue;
        const int picture = pictures.of_frame.at(static_cast<std::size_t>(sample->frame));
        if (const auto score = context.light->at(picture, context.screen->image_from_screen(sample->gaze))) {
            sum += *score;
            ++met;
        }
    }
    const glm::dvec2 place = context.screen->image_from_screen(fixation.place);
    const auto at_place = mean_over_pictures(pictures, [&](int picture) -> std::optional<WeightedScore> {
        const auto score = context.light->at(picture, place);
        return score ? std::optional(WeightedScore{*score}) : std::nullopt;
    });
    // Gaze that does not mind the light meets the point more often while it faces the observer, and what
    // faces the observer is often lit otherwise than what is seen obliquely.
    const glm::dvec3 normal = normal_at(fixation.position, placed, maps->mesh());
    const auto at_point = mean_over_pictures(pictures, [&](int picture) -> std::optional<WeightedScore> {
        const PoseIndex pose = pictures.poses[static_cast<std::size_t>(picture)];
        const SightLines& lines = maps->sight_lines(pose);
        const auto score = context.light->at(picture, glm::dvec2(lines.project(fixation.position)));
        if (!score || !maps->is_visible(pose, fixation.position))
            return std::nullopt;
        return WeightedScore{*score, size_in_picture(lines, fixation.position, normal)};
    });
    if (met > 0 && at_place && at_point)
        fixation.light = {sum / met, *at_place, *at_point};
}

} // namespace

std::pair<std::size_t, std::size_t> samples_between(std::span<const PlacedSample> samples, TrackerTime from,
                                                    TrackerTime to) {
    const auto begin = std::partition_point(
        samples.begin(), samples.end(), [&](const PlacedSample& sample) { return sample.sampled_at < from; });
    const auto end = std::partition_point(
        begin, samples.end(), [&](const PlacedSample& sample) { return sample.sampled_at <= to; });
    return {static_cast<std::size_t>(begin - samples.begin()),
            static_cast<std::size_t>(end - samples.begin())};
}

std::optional<StudyFixation> surface_fixation(const GazeEvent& event, const FixationContext& context) {
    StudyFixation fixation;
    if (!context.clock_map) {
        fixation.duration_s = std::chrono::duration<double>(event.duration).count();
        fixation.why = context.has_stimulus ? NotCounted::no_frame_lit : NotCounted::no_stimulus;
        fixation.place = event.place.value_or(ScreenPoint{});
        return fixation;
    }
    fixation.onset_s = to_seconds(context.clock_map->to_session(event.start).time - context.onset);
    const double end_s = std::min(fixation.onset_s + std::chrono::duration<double>(event.duration).count(),
                                  context.presentation_s);
    if (end_s <= 0.0 || fixation.onset_s >= context.presentation_s)
        return std::nullopt;
    fixation.duration_s = end_s - fixation.onset_s;

    std::vector<const PlacedSample*> lit, placed;
    int met = 0;
    const auto [begin, end] = samples_between(context.samples, event.start, event.end);
    glm::dvec2 sum{0.0};
    for (std::size_t i = begin; i < end; ++i) {
        const PlacedSample& sample = context.samples[i];
        if (!sample.has_gaze || (context.has_stimulus && sample.frame < 0))
            continue;
        lit.push_back(&sample);
        sum += glm::dvec2(sample.gaze.x_px, sample.gaze.y_px);
        if (sample.has_place())
            placed.push_back(&sample);
        met += sample.is_on_surface;
    }
    if (context.has_other_slots && lit.empty())
        return std::nullopt;
    fixation.samples = static_cast<int>(lit.size());
    fixation.place = event.place.value_or(ScreenPoint{});
    if (!lit.empty()) {
        sum /= static_cast<double>(lit.size());
        fixation.place = {sum.x, sum.y};
        const auto all = static_cast<double>(lit.size());
        fixation.on_surface = met / all;
        fixation.within_reach = (static_cast<double>(placed.size()) - met) / all;
        fixation.first_frame = lit.front()->frame;
        fixation.last_frame = lit.back()->frame;
        fixation.mid_pose = lit[lit.size() / 2]->pose;
        fixation.mid_gaze = lit[lit.size() / 2]->gaze;
        fixation.mid_angle_deg =
            context.angles[static_cast<std::size_t>(fixation.mid_pose.value)].angle.value;
    }
    if (!placed.empty()) {
        find_point(fixation, placed, context);
        find_part(fixation, placed);
        if (context.scale) {
            find_spread(fixation, placed, *context.scale);
            const PlacedSample& middle = *placed[placed.size() / 2];
            if (context.cone && context.lookup)
                find_cone(fixation, middle, context);
            fixation.lut_mm = lut_error_mm(middle, context);
            find_motion(fixation, lit, middle, context);
            find_light(fixation, placed, context);
        }
    }
    if (fixation.onset_s < 0.0)
        fixation.why = NotCounted::began_before_onset;
    else if (fixation.duration_s < context.options.shortest_fixation_s)
        fixation.why = NotCounted::too_short;
    else if (!context.has_stimulus)
        fixation.why = NotCounted::no_stimulus;
    else if (lit.empty())
        fixation.why = NotCounted::no_frame_lit;
    else if (!context.has_surface)
        fixation.why = NotCounted::no_surface;
    else if (placed.empty() ||
             fixation.on_surface + fixation.within_reach < context.options.least_on_surface - rounding)
        fixation.why = NotCounted::not_on_surface;
    fixation.only_by_reach =
        fixation.counted() && (met == 0 || fixation.on_surface < context.options.least_on_surface);
    return fixation;
}

} // namespace overt
