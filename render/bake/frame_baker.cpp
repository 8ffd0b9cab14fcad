#include "render/bake/frame_baker.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "render/bake/eye_rays.h"
#include "render/bake/film.h"
#include "render/bake/path_tracer.h"
#include "render/bake/pixel_sampling.h"
#include "render/bake/sample_sequence.h"

namespace overt {

namespace {

void check(const BakeSettings& settings) {
    if (settings.samples < 1 || settings.samples > 65536)
        throw InputError(fmt::format("{} samples a pixel: 1 to 65536 are possible", settings.samples));
    if (!(settings.filter_width_px >= 0.0 && settings.filter_width_px <= 3.0))
        throw InputError(
            fmt::format("a pixel filter {} px wide: 0 to 3 px are possible", settings.filter_width_px));
    if (!(settings.target_error_de >= 0.0))
        throw InputError(
            fmt::format("a target error of {} Delta-E: it cannot be negative", settings.target_error_de));
    OVERT_EXPECTS(settings.pixel_step == 1 || settings.pixel_step == 2);
}

/// Tells how far a frame is, and hears whether to stop.
class ProgressReport {
  public:
    ProgressReport(const BakeProgress& progress, double total) : progress_(&progress), total_(total) {}

    void add(double work) {
        if (!*progress_)
            return;
        const std::scoped_lock lock(mutex_);
        done_ += work;
        if (!stopped_ && !(*progress_)(std::min(1.0, done_ / total_)))
            stopped_ = true;
    }
    bool is_stopped() const { return stopped_; }

  private:
    const BakeProgress* progress_;
    double total_;
    double done_ = 0.0;
    std::mutex mutex_;
    std::atomic<bool> stopped_{false};
};

/// What all samples of a frame share.
struct FrameWork {
    const BakeScene& scene;
    const SpectralLight& light;
    EyeRays eye;
    PixelSampling sampling;
    BakeSettings settings;
    float turn;
    std::optional<glm::mat3> world_from_object; ///< see PathTracer
    std::vector<LightSource> sources;           ///< likewise

    /// Samples first … last - 1 of one pixel.
    void sample(PathTracer& tracer, Film& film, std::size_t index, std::uint32_t first,
                std::uint32_t last) const {
        FilmPixel& pixel = film.pixel(index);
        const glm::ivec2 place = film.place(index);
        Bins light_of_round{};
        for (std::uint32_t sample = first; sample < last; ++sample) {
            SampleSequence sequence(settings.seed, place, sample);
            const glm::vec2 within = glm::vec2(0.5f) + sampling.offset(sequence.next_two());
            const PathRay ray =
                eye.through(static_cast<double>(film.step()) * (glm::dvec2(place) + glm::dvec2(within)));
            pixel.met += tracer.add_sample(ray, sequence, light_of_round) ? 1u : 0u;
        }
        add(pixel.light, light_of_round);
        pixel.samples += last - first;
    }
};

/// Number of samples at the end of each round. With a target each round doubles what was there, after a first
/// in two halves.
std::vector<std::uint32_t> rounds_of(const BakeSettings& settings) {
    const auto all = static_cast<std::uint32_t>(settings.samples);
    if (settings.target_error_de <= 0.0 || all < 8)
        return {all};
    std::vector<std::uint32_t> rounds;
    for (std::uint32_t samples = 8; samples < all; samples *= 2)
        rounds.push_back(samples);
    rounds.push_back(all);
    return rounds;
}

} // namespace

SpectralFrame bake_frame(const BakeScene& scene, const SpectralLight& light, const SceneView& view,
                         const ObjectPose& object, std::span<const std::uint8_t> covered,
                         const BakeSettings& settings, const BakeProgress& progress) {
    check(settings);
    const glm::ivec2 size = view.view.image_px;
    OVERT_EXPECTS(covered.size() == static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    Film film(size, settings.pixel_step, covered);
    const FrameWork work{
        scene,
        light,
        EyeRays(view, object, scene.centre(), 1.01 * static_cast<double>(scene.radius())),
        PixelSampling(settings.filter, settings.filter_width_px),
        settings,
        light.share_of_turn(object.is_turn() ? object.angle : Degrees{0.0}),
        object.is_turn() ? std::nullopt : std::optional(glm::mat3(view.pose_at(object).world_from_object())),
        light.sources_at(object)};
    ProgressReport report(progress, static_cast<double>(film.count()) * settings.samples);
    std::atomic<std::uint64_t> rays{0};
    // In whole millionths, whose sum does not hang on the order.
    std::atomic<std::uint64_t> given_up{0}, paths{0};
    std::vector<std::uint32_t> active(film.count());
    std::iota(active.begin(), active.end(), 0u);
    std::uint32_t first = 0;
    const std::vector<std::uint32_t> rounds = rounds_of(settings);
    for (const std::uint32_t last : rounds) {
        film.begin_round(active);
        constexpr std::size_t batch = 64;
        parallel_for(
            static_cast<int>((active.size() + batch - 1) / batch),
            [&](int number) {
                if (report.is_stopped())
                    return;
                PathTracer tracer(scene, light, work.turn,
                                  work.world_from_object ? &*work.world_from_object : nullptr, work.sources);
                const std::size_t begin = static_cast<std::size_t>(number) * batch;
                const std::size_t end = std::min(begin + batch, active.size());
                for (std::size_t i = begin; i < end; ++i)
                    work.sample(tracer, film, active[i], first, last);
                rays += tracer.rays();
                given_up += static_cast<std::uint64_t>(std::llround(1e6 * tracer.given_up()));
                paths += static_cast<std::uint64_t>(end - begin) * (last - first);
                report.add(static_cast<double>(end - begin) * (last - first));
            },
            settings.most_threads);
        if (report.is_stopped())
            return {};
        first = last;
        if (rounds.size() > 1 && last > rounds.front())
            active = film.noisier_than(settings.target_error_de, light.exposure(), last);
    }
    SpectralFrame frame = film.develop(covered);
    frame.rays = static_cast<double>(rays.load());
    if (paths > 0)
        frame.given_up = 1e-6 * static_cast<double>(given_up.load()) / static_cast<double>(paths.load());
    frame.is_complete = true;
    return frame;
}

std::vector<std::uint8_t> covered_pixels(const BakeScene& scene, const SceneView& view,
                                         const ObjectPose& object) {
    const glm::ivec2 size = view.view.image_px;
    const EyeRays eye(view, object, scene.centre(), 1.01 * static_cast<double>(scene.radius()));
    std::vector<std::uint8_t> covered(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    parallel_for(size.y, [&](int row) {
        for (int column = 0; column < size.x; ++column) {
            const PathRay ray = eye.through(glm::dvec2(column, row) + 0.5);
            covered[static_cast<std::size_t>(row) * static_cast<std::size_t>(size.x) +
                    static_cast<std::size_t>(column)] =
                scene.body_tree().first_distance(ray, true) >= 0.0f ? 1 : 0;
        }
    });
    return covered;
}

} // namespace overt
