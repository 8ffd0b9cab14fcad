#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "app/bench/bench_clock.h"
#include "app/bench/bench_command.h"
#include "app/bench/bench_gaze.h"
#include "app/cli/progress_bar.h"
#include "app/cli/resident_memory.h"
#include "experiment/analysis/gaze_cone.h"
#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/record/read/sample_join.h"
#include "render/gl/headless_context.h"
#include "render/stimulus/coordinate_pass.h"

namespace overt {

namespace {

constexpr int presentations = 12;
constexpr int repeats = 5;
constexpr int compared_places = 200'000;

std::vector<TriangleMap> draw_maps(const GlContext& context, const Object& object, const PoseTable& poses) {
    CoordinatePass pass(context, object.scene().view.image_px);
    const MeshBuffers buffers(context, object.mesh);
    std::vector<TriangleMap> maps;
    ProgressBar bar;
    for (const ObjectPose& angle : poses.angles) {
        maps.push_back({object.scene().view.image_px, pass.draw(buffers, object.scene(), angle)});
        bar.update("maps of " + object.id, static_cast<int>(maps.size()),
                   static_cast<int>(poses.angles.size()));
    }
    bar.finish();
    return maps;
}

/// One object under measurement.
class Reprojection {
  public:
    Reprojection(const Protocol& protocol, const Object& object, const CoordinateMaps& maps,
                 const PoseTable& poses, BenchFigures& figures)
        : protocol_(protocol), object_(object), maps_(maps), poses_(poses), figures_(figures),
          screen_(screen_geometry_of(protocol)) {}

    void measure_speed(GazeKind kind, const std::string& name) {
        const auto recordings = bench_recordings(protocol_, screen_, maps_, kind, presentations);
        std::vector<JoinedSample> joined;
        double least_s = std::numeric_limits<double>::infinity();
        std::size_t samples = 0, on_object = 0;
        for (int repeat = 0; repeat < repeats; ++repeat) {
            double spent_s = 0.0;
            samples = on_object = 0;
            for (const BenchRecording& recording : recordings) {
                const SampleJoin join(screen_, recording.clock_map, recording.history, &maps_);
                joined.resize(std::min<std::size_t>(1024, recording.samples.size()));
                for (std::size_t begin = 0; begin < recording.samples.size(); begin += joined.size()) {
                    const auto part =
                        std::span(recording.samples)
                            .subspan(begin, std::min(joined.size(), recording.samples.size() - begin));
                    const double before_s = thread_seconds();
                    join.join(part, std::span(joined).first(part.size()));
                    spent_s += thread_seconds() - before_s;
                    for (const JoinedSample& sample : std::span(joined).first(part.size()))
                        on_object += sample.sight.surface.has_value();
                }
                samples += recording.samples.size();
            }
            least_s = std::min(least_s, spent_s);
        }
        add(at_least(name + ", samples joined per second and core",
                     1e-6 * static_cast<double>(samples) / least_s, "million/s", 5.0));
        add({name + ", samples on the object",
             100.0 * static_cast<double>(on_object) / static_cast<double>(samples), "%"});
    }

    void measure_contested_pixels();
    void measure_side_by_side();
    void measure_exactness();
    void measure_cone();

  private:
    void add(BenchFigure figure) {
        figure.figure = object_.id + ", " + figure.figure;
        figures_.push_back(std::move(figure));
    }

    const Protocol& protocol_;
    const Object& object_;
    const CoordinateMaps& maps_;
    const PoseTable& poses_;
    BenchFigures& figures_;
    ScreenGeometry screen_;
};

void Reprojection::measure_contested_pixels() {
    const PoseCells& cells = maps_.cells({0});
    std::size_t covered = 0, contested = 0, contested_beside = 0;
    for (int y = 0; y < cells.size_px().y; ++y) {
        for (int x = 0; x < cells.size_px().x; ++x) {
            const PixelCell cell = cells.cell({x, y});
            covered += cell.is_covered();
            contested += cell.is_contested() && cell.is_covered();
            contested_beside += cell.is_contested() && !cell.is_covered();
        }
    }
    add({"pixels on the object asked by ray",
         100.0 * static_cast<double>(contested) / static_cast<double>(covered), "%"});
    add({"pixels beside the object asked by ray", static_cast<double>(contested_beside), ""});
}

/// Errors of look-ups against rays through the same places, in LSB, sorted.
struct Errors {
    std::vector<double> lsb;
    double quantile(double share) const {
        return lsb.empty() ? 0.0
                           : lsb[std::min(lsb.size() - 1,
                                          static_cast<std::size_t>(share * static_cast<double>(lsb.size())))];
    }
};

void Reprojection::measure_exactness() {
    const RayCaster rays(object_.mesh);
    const glm::dvec3 lsb = glm::max(object_.scene().bounds.extent() / 65536.0, glm::dvec3(1e-300));
    struct Outcome {
        bool differs = false, interior = false, edge = false;
        double error = 0.0, centre_error = -1.0;
    };
    std::vector<Outcome> outcomes(compared_places);
    parallel_for(compared_places / 1000, [&](int batch) {
        RandomStream random(2, "compared places", static_cast<std::uint64_t>(batch));
        for (int i = 0; i < 1000; ++i) {
            const PoseIndex pose{
                static_cast<int>(random.below(static_cast<std::uint32_t>(poses_.angles.size())))};
            const glm::ivec2 size = maps_.image_px();
            const glm::dvec2 place(random.uniform(0.0, size.x), random.uniform(0.0, size.y));
            const SceneView& scene = object_.scene();
            const auto cast = [&](glm::dvec2 at) {
                return rays.first_hit(
                    to_object(scene.view.ray_through(at),
                              scene.pose_at(poses_.angles[static_cast<std::size_t>(pose.value)])));
            };
            const auto error = [&](glm::dvec3 a, glm::dvec3 b) {
                const glm::dvec3 apart = glm::abs(a - b) / lsb;
                return std::max({apart.x, apart.y, apart.z});
            };
            Outcome& outcome = outcomes[static_cast<std::size_t>(batch * 1000 + i)];
            const auto hit = cast(place);
            const auto surface = maps_.surface_at(pose, place);
            outcome.differs = hit.has_value() != surface.has_value();
            if (!hit || !surface)
                continue;
            bool interior = true;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const glm::ivec2 pixel = glm::ivec2(place) + glm::ivec2(dx, dy);
                    interior = interior && maps_.cells(pose).is_inside(pixel) &&
                               maps_.cells(pose).cell(pixel).is_covered() &&
                               !maps_.cells(pose).cell(pixel).is_contested();
                }
            }
            outcome.interior = interior;
            outcome.edge = !interior;
            outcome.error = error(hit->position, surface->position);
            if (const auto centre = cast(glm::floor(place) + 0.5))
                outcome.centre_error = error(hit->position, centre->position);
        }
    });
    Errors interior, edge, centre;
    int differs = 0;
    for (const Outcome& outcome : outcomes) {
        differs += outcome.differs;
        if (outcome.interior)
            interior.lsb.push_back(outcome.error);
        if (outcome.edge)
            edge.lsb.push_back(outcome.error);
        if (outcome.interior && outcome.centre_error >= 0.0)
            centre.lsb.push_back(outcome.centre_error);
    }
    for (Errors* errors : {&interior, &edge, &centre})
        std::sort(errors->lsb.begin(), errors->lsb.end());
    add({"places compared with rays", compared_places, ""});
    add(at_most("places on the object for one and beside it for the other", differs, "", 0));
    add(at_most("interior, error 99.9 %", interior.quantile(0.999), "LSB", 0.05));
    add({"interior, error max", interior.quantile(1.0), "LSB"});
    add(at_most("at edges, error 99.9 %", edge.quantile(0.999), "LSB", 0.05));
    add({"at edges, error max", edge.quantile(1.0), "LSB"});
    add({"interior, nearest pixel instead, error median", centre.quantile(0.5), "LSB"});
    add({"interior, nearest pixel instead, error 99.9 %", centre.quantile(0.999), "LSB"});
}

/// The object twice on one screen, gaze going from one to the other: each sample is joined with both slots,
/// and compared with a ray through its own.
void Reprojection::measure_side_by_side() {
    constexpr std::size_t samples_in_a_row = 400; // a fifth of a second
    constexpr double gap_px = 100.0;
    std::array<ScreenGeometry, 2> slots{screen_, screen_};
    for (ScreenGeometry& slot : slots)
        slot.screen_px.x = 2 * slot.image_px.x + static_cast<int>(gap_px);
    slots[0].image_origin_px.x = 0;
    slots[1].image_origin_px.x = slots[0].screen_px.x - slots[0].image_px.x;
    const SceneView& scene = object_.scene();
    const RayCaster rays(object_.mesh);
    const double limit = 1e-6 * glm::length(scene.bounds.extent());
    int compared = 0, elsewhere = 0, in_both = 0;
    double spent_s = 0.0;
    for (BenchRecording& recording : bench_recordings(protocol_, screen_, maps_, GazeKind::fixations, 2)) {
        const auto in_second = [&](std::size_t sample) { return sample / samples_in_a_row % 2 == 1; };
        for (std::size_t i = 0; i < recording.samples.size(); ++i)
            recording.samples[i].gaze = slots[in_second(i) ? 1 : 0].screen_from_image(
                screen_.image_from_screen(*recording.samples[i].gaze));
        std::array<std::vector<JoinedSample>, 2> joined;
        for (std::size_t slot = 0; slot < slots.size(); ++slot) {
            const SampleJoin join(slots[slot], recording.clock_map, recording.history, &maps_, true);
            joined[slot].resize(recording.samples.size());
            const double before_s = thread_seconds();
            join.join(recording.samples, joined[slot]);
            spent_s += thread_seconds() - before_s;
        }
        for (std::size_t i = 0; i < recording.samples.size(); ++i) {
            const std::size_t own = in_second(i) ? 1 : 0;
            in_both += joined[1 - own][i].sight.surface.has_value() || joined[1 - own][i].shown.has_value();
            const JoinedSample& sample = joined[own][i];
            if (!sample.shown)
                continue;
            const auto hit = rays.first_hit(
                to_object(scene.view.ray_through(*sample.image_px),
                          scene.pose_at(poses_.angles[static_cast<std::size_t>(sample.shown->pose.value)])));
            ++compared;
            elsewhere += hit.has_value() != sample.sight.surface.has_value() ||
                         (hit && glm::distance(hit->position, sample.sight.surface->position) > limit);
        }
    }
    add({"two side by side, samples compared with rays", static_cast<double>(compared), ""});
    add(at_most("two side by side, samples elsewhere than their ray", elsewhere, "", 0));
    add(at_most("two side by side, samples in the other slot, too", in_both, "", 0));
    add({"two side by side, samples joined per second and core", 1e-6 * compared / spent_s, "million/s"});
}

void Reprojection::measure_cone() {
    const GazeCone cone(screen_);
    RandomStream random(3, "cones");
    constexpr int cones = 2000;
    const std::size_t parts = object_.mesh->part_names.size();
    std::vector<ScreenPoint> gazes;
    for (int i = 0; i < cones; ++i)
        gazes.push_back(screen_.screen_from_image(
            {random.uniform(0.0, maps_.image_px().x), random.uniform(0.0, maps_.image_px().y)}));
    const auto mean_us = [&](const auto& work) {
        const double before_s = thread_seconds();
        for (int i = 0; i < cones; ++i)
            work(PoseIndex{i % static_cast<int>(maps_.pose_count())}, gazes[static_cast<std::size_t>(i)]);
        return 1e6 * (thread_seconds() - before_s) / cones;
    };
    double on_object = 0.0;
    add({"cone of 0.5 deg, probabilities of object and parts", mean_us([&](PoseIndex pose, ScreenPoint gaze) {
             on_object += cone.shares(maps_, pose, gaze, parts).of_object / cones;
         }),
         "us/sample"});
    std::size_t points = 0;
    add({"cone of 0.5 deg, distribution over surface points", mean_us([&](PoseIndex pose, ScreenPoint gaze) {
             points += cone.on_surface(maps_, pose, gaze).size();
         }),
         "us/sample"});
    // The two go by pixels and by sub-pixel places: on average they agree.
    add({"cone of 0.5 deg, probability of the object, mean", on_object, ""});
    add({"the same by its surface points",
         static_cast<double>(points) / (static_cast<double>(cones) * GazeCone::usual_directions), ""});
}

} // namespace

BenchFigures bench_reproject(const BenchOptions& options) {
    const BenchScene scene = bench_scene(options);
    const PoseTable poses = poses_of(scene.protocol);
    BenchFigures figures;
    const auto context = make_headless_context(options.context);
    for (const Object& object : scene.objects) {
        std::vector<TriangleMap> drawn = draw_maps(*context, object, poses);
        // The maps are handed over: they count, what OpenGL keeps of drawing them does not.
        const double drawn_mb = static_cast<double>(drawn.size() * drawn.front().codes.size()) * 4e-6;
        const double before_mb = resident_memory_mb() - drawn_mb;
        const auto begin = std::chrono::steady_clock::now();
        const CoordinateMaps maps(object.mesh, object.scene(), poses.angles, std::move(drawn));
        const double making_s = seconds_since(begin);
        figures.push_back(
            {object.id + ", triangles", static_cast<double>(object.mesh->triangles.size()), ""});
        figures.push_back(at_most(object.id + ", memory of all maps with the surface",
                                  resident_memory_mb() - before_mb, "MB", 256.0));
        figures.push_back({object.id + ", making the maps ready for questions", making_s, "s"});
        Reprojection reprojection(scene.protocol, object, maps, poses, figures);
        reprojection.measure_contested_pixels();
        reprojection.measure_speed(GazeKind::fixations, "fixations");
        reprojection.measure_speed(GazeKind::uniform, "uniform gaze");
        reprojection.measure_side_by_side();
        reprojection.measure_exactness();
        reprojection.measure_cone();
    }
    return figures;
}

} // namespace overt
