#include "app/stimuli/bake_estimate.h"

#include <chrono>

#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/stimuli/bake_errors.h"
#include "app/stimuli/bake_plan.h"
#include "app/stimuli/live_errors.h"
#include "experiment/base/counted.h"
#include "experiment/protocol/keys/protocol_keys.h"

namespace overt {

namespace {

/// A small picture to measure the time of paths by.
struct ProbeSize {
    int px = 96, samples = 8;
};
/// Paths through what is translucent are some hundred times as long, and so many fewer tell their time.
constexpr ProbeSize usual_probe, translucent_probe{48, 2};

/// Whether its paths take the longer the larger the object is.
bool is_by_size(const MaterialSettings& material) { return material.kind == MaterialKind::translucent; }

/// For compressing and writing a pixel, on one processor of 2.5 GHz.
constexpr double writing_s_per_px = 0.15e-6;

SceneView small_view(const SceneView& scene, const ProbeSize& size) {
    SceneView small = scene;
    const int longer = std::max(scene.view.image_px.x, scene.view.image_px.y);
    small.view.image_px = glm::max(scene.view.image_px * std::min(size.px, longer) / longer, glm::ivec2(1));
    return small;
}

double share_of(const std::vector<std::uint8_t>& covered) {
    return static_cast<double>(std::count(covered.begin(), covered.end(), 1)) /
           static_cast<double>(covered.size());
}

double seconds_per_path(const BakeScene& scene, const SpectralLight& light, const SceneView& view,
                        const std::vector<std::uint8_t>& covered, const ProbeSize& size) {
    BakeSettings settings;
    settings.samples = size.samples;
    const auto begin = std::chrono::steady_clock::now();
    const SpectralFrame frame = bake_frame(scene, light, view, {{0.0}}, covered, settings);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    double paths = 1.0;
    for (const std::uint16_t samples : frame.samples)
        paths += samples;
    return taken.count() / paths;
}

} // namespace

PathProbe::PathProbe(const Protocol& protocol, std::span<const Object> objects)
    : protocol_(&protocol), seconds_per_path_(objects.size() * protocol.materials.size(), 0.0),
      traced_share_(objects.size(), 0.0) {
    const LightSettings& first = protocol.lights.front();
    const SpectralLight light(first.parts.empty() ? first : first.parts.front());
    std::vector<double> seconds(protocol.materials.size(), 0.0); // of the first object, and so of all
    bool is_first = true;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Object& object = objects[i];
        if (!object.has_mesh())
            continue;
        bool is_covered = false;
        for (std::size_t material = 0; material < protocol.materials.size(); ++material) {
            const bool is_own_time = is_by_size(protocol.materials[material]);
            if (is_covered && !is_first && !is_own_time)
                continue;
            const BakeScene scene(object.mesh, protocol.materials[material], object.appearance);
            const ProbeSize& size = is_own_time ? translucent_probe : usual_probe;
            const SceneView view = small_view(object.scene(), size);
            const std::vector<std::uint8_t> covered = covered_pixels(scene, view, {{0.0}});
            if (!is_covered)
                traced_share_[i] = share_of(covered);
            is_covered = true;
            if (is_first || is_own_time)
                seconds[material] = seconds_per_path(scene, light, view, covered, size);
        }
        std::ranges::copy(seconds, seconds_per_path_.begin() +
                                       static_cast<std::ptrdiff_t>(i * protocol.materials.size()));
        is_first = false;
    }
}

double PathProbe::seconds_of_frame(const Stimulus& stimulus, const FrameQuality& quality) const {
    const auto material = static_cast<std::size_t>(stimulus.material);
    const BakeSettings settings =
        bake_settings(quality, protocol_->bake, protocol_->materials[material].kind);
    const ViewSettings& view = protocol_->view_of(stimulus);
    const double pixels = static_cast<double>(view.width_px) * view.height_px;
    const double paths = pixels * traced_share_[static_cast<std::size_t>(stimulus.object)] *
                         settings.samples / (settings.pixel_step * settings.pixel_step);
    if (!protocol_->light_of(stimulus).sum.empty())
        return pixels * writing_s_per_px; // added up
    const std::size_t of = static_cast<std::size_t>(stimulus.object) * protocol_->materials.size() + material;
    return paths * seconds_per_path_[of] + pixels * writing_s_per_px;
}

BakeEstimate bake_estimate(const Experiment& experiment, const StimulusLibrary& library) {
    BakeEstimate estimate;
    estimate.wanted = experiment.protocol.bake.least();
    estimate.wanted_by_simulated = experiment.protocol.bake.least(false);
    const std::vector<Stimulus> stimuli = library.cache().rendered_stimuli();
    if (stimuli.empty() || estimate.wanted == BakeQuality::live)
        return estimate;
    estimate.for_session = library.quality_of_session(estimate.wanted);
    estimate.for_simulated = library.quality_of_session(estimate.wanted_by_simulated);
    const FrameRange all_frames = frame_range_called("all", experiment.protocol, stimuli);
    std::optional<PathProbe> probe;
    for (const BakeQuality quality :
         {BakeQuality::preview, BakeQuality::draft, BakeQuality::standard, BakeQuality::reference}) {
        QualityEstimate one{quality_of(quality, experiment.protocol.bake)};
        for (const BakeUnit& unit : bake_units(stimuli, all_frames, library.cache(), one.quality, false)) {
            ++one.frames;
            if (library.cache().has_frame(unit.stimulus, one.quality, unit.pose)) {
                ++one.there;
                continue;
            }
            if (!probe)
                probe.emplace(experiment.protocol, experiment.objects);
            one.seconds_left += probe->seconds_of_frame(unit.stimulus, one.quality);
        }
        estimate.qualities.push_back(one);
    }
    return estimate;
}

std::string duration_text(double seconds) {
    if (seconds < 90.0)
        return fmt::format("{:.0f} s", std::max(1.0, seconds));
    if (seconds < 5400.0)
        return fmt::format("{:.0f} min", seconds / 60.0);
    return fmt::format("{:.1f} h", seconds / 3600.0);
}

namespace {

std::string what_it_takes(const std::optional<FrameQuality>& there, BakeQuality wanted) {
    if (there)
        return fmt::format("takes {}.\n", describe(*there));
    if (wanted == BakeQuality::preview)
        return "renders previews before it begins.\n";
    return fmt::format("is refused until `overt bake` has made {} quality.\n", name_of(wanted));
}

constexpr const char* what_live_lacks =
    "drawn by OpenGL without waiting: no light from one part of a surface to "
    "another but a guess, and no spectra";

const QualityEstimate* estimate_of(const BakeEstimate& estimate, BakeQuality quality) {
    const auto found = std::ranges::find_if(
        estimate.qualities, [&](const QualityEstimate& one) { return one.quality.level == quality; });
    return found == estimate.qualities.end() ? nullptr : &*found;
}

/// Such as "1.8 (smooth-conductor), not measured (diffuse)".
std::string errors_of(const FrameQuality& quality, const Protocol& protocol) {
    std::string errors;
    std::vector<MaterialKind> said;
    for (const MaterialSettings& material : protocol.materials) {
        if (std::ranges::find(said, material.kind) != said.end())
            continue;
        said.push_back(material.kind);
        const int samples = bake_settings(quality, protocol.bake, material.kind).samples;
        const std::optional<double> error = mean_delta_e(material.kind, samples);
        errors += fmt::format("{}{} ({})", errors.empty() ? "" : ", ",
                              error ? fmt::format("{:.3g}", *error) : "not measured", name_of(material.kind));
    }
    return errors;
}

std::string time_of(const QualityEstimate& one) {
    return fmt::format("{} of {} frames are there; about {} more on this machine", one.there, one.frames,
                       duration_text(one.seconds_left));
}

} // namespace

std::string needs_of_person(const BakeEstimate& estimate, const Protocol& protocol) {
    std::string text = "Before a session with a person\n\n";
    if (estimate.wanted == BakeQuality::live)
        return text + fmt::format("  Nothing: the protocol asks for live frames, {}.\n  {}\n\n",
                                  what_live_lacks, live_differences_of(protocol));
    const QualityEstimate* const wanted = estimate_of(estimate, estimate.wanted);
    if (!wanted)
        return text + "  Nothing: all frames are given.\n\n";
    if (estimate.for_session)
        return text + fmt::format("  Nothing: all its frames are there, of {}.\n\n",
                                  describe(*estimate.for_session));
    const std::string bake = fmt::format("overt bake {}", protocol.file.string());
    text += fmt::format("  It needs {} quality, and is refused until then: {}.\n    {}\n",
                        name_of(estimate.wanted), time_of(*wanted), bake);
    const QualityEstimate* const draft = estimate_of(estimate, BakeQuality::draft);
    if (draft && estimate.wanted > BakeQuality::draft) {
        text += fmt::format(
            "  The cheapest way that is honest: drafts, for pilots; {}.\n    {} --quality draft\n"
            "    and in the protocol [bake] quality = \"draft\", or overt run … --quality draft once\n",
            time_of(*draft), bake);
        text += fmt::format(
            "  The mean error of drafts in CIE Delta-E ab: {}; of {} quality: {}. As overt bench bake "
            "holds it under the overcast sky; 2.3 is just noticeable side by side. The record names "
            "the quality.\n",
            errors_of(draft->quality, protocol), name_of(estimate.wanted),
            errors_of(wanted->quality, protocol));
    }
    text += fmt::format("  Quality live: {}.\n  {}\n", what_live_lacks, live_differences_of(protocol));
    if (std::ranges::any_of(protocol.materials, &MaterialSettings::is_of_file))
        text += "  Of an object's own surface it shows colours and what is metal at their places, roughness "
                "in the "
                "mean of each of the file's materials, and no bumps.\n";
    if (std::ranges::find(protocol.materials, MaterialKind::translucent, &MaterialSettings::kind) !=
        protocol.materials.end())
        text +=
            "  A translucent body it shows as a matt one under its border, of the colour that a thick one "
            "has: light that comes through, or out beside where it went in, is missing.\n";
    return text +
           fmt::format(
               "  Times are estimated from small pictures that were traced just now, on {}, if nothing "
               "else runs.\n\n",
               counted(std::max(1u, std::thread::hardware_concurrency()), "processor"));
}

std::string to_text(const BakeEstimate& estimate) {
    if (estimate.qualities.empty())
        return {};
    std::string text = "\nRendered stimuli, and what the rest will take here if nothing else runs\n\n";
    for (const QualityEstimate& one : estimate.qualities) {
        const std::string left =
            one.there == one.frames ? "" : fmt::format(", about {} left", duration_text(one.seconds_left));
        text +=
            fmt::format("  {:<28}{} of {} frames{}\n", describe(one.quality), one.there, one.frames, left);
    }
    text += "  A session " + what_it_takes(estimate.for_session, estimate.wanted);
    if (estimate.wanted_by_simulated != estimate.wanted)
        text += "  One with a simulated observer " +
                what_it_takes(estimate.for_simulated, estimate.wanted_by_simulated);
    return text;
}

nlohmann::ordered_json to_json(const BakeEstimate& estimate) {
    auto qualities = nlohmann::ordered_json::array();
    for (const QualityEstimate& one : estimate.qualities)
        qualities.push_back({{"quality", name_of(one.quality.level)},
                             {"frames_there", one.there},
                             {"frames", one.frames},
                             {"seconds_left", one.seconds_left}});
    return {{"grades", qualities},
            {"session_takes", estimate.for_session ? name_of(estimate.for_session->level) : "nothing"},
            {"session_needs", name_of(estimate.wanted)},
            {"simulated_session_takes",
             estimate.for_simulated ? name_of(estimate.for_simulated->level) : "nothing"},
            {"simulated_session_needs", name_of(estimate.wanted_by_simulated)}};
}

} // namespace overt
