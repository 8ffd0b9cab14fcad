#include "render/stimulus/stimulus_library.h"

#include <exception>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/protocol/protocol_keys.h"
#include "render/stimulus/frame_description.h"
#include "render/stimulus/frame_key.h"
#include "render/stimulus/observed_colours.h"
#include "render/stimulus/ready_made_frames.h"

namespace overt {

StimulusLibrary::StimulusLibrary(const GlContext& context, const Protocol& protocol,
                                 std::span<const Sculpture> sculptures, std::filesystem::path cache)
    : context_(&context), protocol_(&protocol), sculptures_(sculptures), cache_(std::move(cache)),
      poses_(distinct_poses(protocol.animation)), surroundings_(hash_of_surroundings(protocol.light)),
      qualities_(sculptures.size() * protocol.materials.size(),
                 quality_of(protocol.bake.quality, protocol.bake)),
      tracer_(protocol, sculptures) {}

void StimulusLibrary::prepare_frames(const Progress& progress, std::optional<BakeQuality> least) {
    for (const FrameSequenceSettings& sequence : protocol_->frames)
        check_frame_sizes(sequence, protocol_->animation.frame_count,
                          {protocol_->view.width_px, protocol_->view.height_px});
    const std::vector<Condition> stimuli = rendered_stimuli();
    for (const Condition& stimulus : stimuli)
        require_mesh(stimulus);
    const BakeQuality wanted = least.value_or(protocol_->bake.quality);
    if (const std::optional<FrameQuality> best = best_quality(stimuli, wanted)) {
        take_frames(*best);
        return;
    }
    const FrameQuality quality = quality_of(wanted, protocol_->bake);
    if (wanted > BakeQuality::preview) {
        std::size_t missing = 0;
        for (const Condition& stimulus : stimuli)
            missing += missing_frames(stimulus, quality).size();
        throw InputError(fmt::format("{}: [bake] asks for {} quality, and {} of {} frames are not baked yet: "
                                     "run `overt bake {}`, or be content with --quality preview",
                                     protocol_->file.string(), describe(quality), missing,
                                     stimuli.size() * poses_.angles.size(), protocol_->file.string()));
    }
    make_frames(stimuli, quality, progress);
}

void StimulusLibrary::prepare_frames(const Condition& condition, const Progress& progress) {
    if (const FrameSequenceSettings* sequence = sequence_of(condition)) {
        check_frame_sizes(*sequence, protocol_->animation.frame_count,
                          {protocol_->view.width_px, protocol_->view.height_px});
        return;
    }
    require_mesh(condition);
    const std::span<const Condition> one(&condition, 1);
    const BakeQuality least = std::min(protocol_->bake.quality, BakeQuality::preview);
    if (const std::optional<FrameQuality> best = best_quality(one, least)) {
        qualities_[index_of(condition)] = *best;
        return;
    }
    make_frames(one, quality_of(least, protocol_->bake), progress);
}

bool StimulusLibrary::is_complete(std::span<const Condition> conditions, const FrameQuality& quality) const {
    return std::all_of(conditions.begin(), conditions.end(), [&](const Condition& condition) {
        return missing_frames(condition, quality).empty();
    });
}

std::optional<FrameQuality> StimulusLibrary::best_quality(std::span<const Condition> conditions,
                                                          BakeQuality least) const {
    std::vector<BakeQuality> levels{BakeQuality::reference, BakeQuality::standard, BakeQuality::draft,
                                    BakeQuality::preview};
    // Who asks for live frames gets live frames.
    if (least == BakeQuality::live)
        levels = {BakeQuality::live};
    for (const BakeQuality level : levels) {
        const FrameQuality quality = quality_of(level, protocol_->bake);
        if (level >= least && is_complete(conditions, quality))
            return quality;
    }
    return std::nullopt;
}

void StimulusLibrary::make_frames(std::span<const Condition> conditions, const FrameQuality& quality,
                                  const Progress& progress) {
    double all = 0.0, done = 0.0;
    int count = 0, frames = 0;
    const auto cost_of = [&](const Condition& condition) {
        return quality.is_live() ? 1.0 : expected_cost(quality, *protocol_, material_of(condition).kind);
    };
    for (const Condition& condition : conditions) {
        qualities_[index_of(condition)] = quality;
        remove_abandoned_files(frame_file_of(condition, quality, {0}).parent_path());
        const auto missing = static_cast<int>(missing_frames(condition, quality).size());
        all += missing * cost_of(condition);
        count += missing;
    }
    const std::string what = quality.is_live() ? "drawing frames" : "rendering previews";
    // While one frame is compressed and written, the next is made.
    std::future<void> writing;
    // The tracer's threads hear from a progress that throws only that they are to stop.
    std::exception_ptr stopped;
    for (const Condition& condition : conditions) {
        for (const PoseIndex pose : missing_frames(condition, quality)) {
            const double cost = cost_of(condition);
            const auto tell = [&](double share_of_frame) {
                try {
                    if (progress)
                        progress(what, frames, count, (done + share_of_frame * cost) / all);
                } catch (...) {
                    stopped = std::current_exception();
                }
                return !stopped;
            };
            if (!tell(0.0))
                std::rethrow_exception(stopped);
            if (quality.is_live()) {
                draw_live_frame(condition, pose, writing);
            } else {
                SpectralFrame frame = trace(condition, pose, quality, tell);
                if (writing.valid())
                    writing.get();
                if (stopped)
                    std::rethrow_exception(stopped);
                writing = std::async(std::launch::async,
                                     [this, condition, pose, quality, frame = std::move(frame)] {
                                         store(condition, pose, quality, frame);
                                     });
            }
            done += cost;
            ++frames;
        }
    }
    if (writing.valid())
        writing.get();
    if (progress && count > 0)
        progress(what, count, count, 1.0);
}

void StimulusLibrary::draw_live_frame(const Condition& condition, PoseIndex pose,
                                      std::future<void>& writing) {
    const Sculpture& sculpture = sculptures_[static_cast<std::size_t>(condition.sculpture)];
    const MaterialSettings& material = material_of(condition);
    const std::filesystem::path file = frame_file_of(condition, qualities_[index_of(condition)], pose);
    std::filesystem::create_directories(file.parent_path());
    if (!renderer_)
        renderer_.emplace(*context_, protocol_->light, sculpture.scene.view.image_px);
    if (live_material_ != condition.material)
        renderer_->set_material(material);
    live_material_ = condition.material;
    const Degrees angle = poses_.angles[static_cast<std::size_t>(pose.value)];
    LinearImage image = renderer_->draw(buffers_of(condition.sculpture, true), sculpture.scene, angle);
    if (writing.valid())
        writing.get();
    ImageAttributes attributes = describe_stimulus(*protocol_, sculpture, material, angle);
    attributes.emplace_back("overt:renderer", "OpenGL");
    writing =
        std::async(std::launch::async, [file, image = std::move(image), attributes = std::move(attributes)] {
            write_linear_exr(file, image, attributes);
        });
}

SpectralFrame StimulusLibrary::trace(const Condition& condition, PoseIndex pose, const FrameQuality& quality,
                                     const BakeProgress& progress) {
    draw_missing_map(condition.sculpture, pose);
    return tracer_.trace(condition, poses_.angles[static_cast<std::size_t>(pose.value)],
                         read_triangle_map(map_file(condition.sculpture, pose)),
                         bake_settings(quality, protocol_->bake, material_of(condition).kind), progress);
}

void StimulusLibrary::store(const Condition& condition, PoseIndex pose, const FrameQuality& quality,
                            const SpectralFrame& frame) const {
    OVERT_EXPECTS(frame.is_complete);
    const std::filesystem::path file = frame_file_of(condition, quality, pose);
    std::filesystem::create_directories(file.parent_path());
    const Degrees angle = poses_.angles[static_cast<std::size_t>(pose.value)];
    const MaterialSettings& material = material_of(condition);
    ImageAttributes attributes = describe_stimulus(
        *protocol_, sculptures_[static_cast<std::size_t>(condition.sculpture)], material, angle);
    for (auto& attribute : describe_tracing(quality, *protocol_, material.kind))
        attributes.push_back(std::move(attribute));
    attributes.emplace_back("overt:key", frame_key(condition, quality));
    write_linear_exr(file, seen_by(protocol_->bake.observer, frame), attributes);
}

const FrameQuality& StimulusLibrary::quality_of_frames(const Condition& condition) const {
    return qualities_[index_of(condition)];
}

std::vector<Condition> StimulusLibrary::rendered_stimuli() const {
    std::vector<Condition> stimuli;
    for (int sculpture = 0; sculpture < static_cast<int>(sculptures_.size()); ++sculpture) {
        for (int material = 0; material < static_cast<int>(protocol_->materials.size()); ++material) {
            if (!is_ready_made({sculpture, material}))
                stimuli.push_back({sculpture, material});
        }
    }
    return stimuli;
}

void StimulusLibrary::require_mesh(const Condition& condition) const {
    const Sculpture& sculpture = sculptures_[static_cast<std::size_t>(condition.sculpture)];
    if (!sculpture.has_mesh()) {
        throw InputError(fmt::format("{}, {}: there is neither a mesh to render nor [[frames]] to show",
                                     protocol_->sculptures[static_cast<std::size_t>(condition.sculpture)].id,
                                     material_of(condition).id));
    }
}

std::vector<PoseIndex> StimulusLibrary::missing_frames(const Condition& condition,
                                                       const FrameQuality& quality) const {
    std::vector<PoseIndex> missing;
    const ContentHash key = frame_key(condition, quality);
    for (int pose = 0; pose < static_cast<int>(poses_.angles.size()); ++pose) {
        if (!std::filesystem::exists(cached("frames", key, pose)))
            missing.push_back({pose});
    }
    return missing;
}

std::filesystem::path StimulusLibrary::frame_file_of(const Condition& condition, const FrameQuality& quality,
                                                     PoseIndex pose) const {
    return cached("frames", frame_key(condition, quality), pose.value);
}

ContentHash StimulusLibrary::frame_key(const Condition& condition, const FrameQuality& quality) const {
    const Sculpture& sculpture = sculptures_[static_cast<std::size_t>(condition.sculpture)];
    const MaterialSettings& material = material_of(condition);
    if (quality.is_live())
        return live_key(sculpture, material, surroundings_, protocol_->light.exposure);
    return traced_key(sculpture, material, surroundings_, protocol_->light.exposure,
                      bake_settings(quality, protocol_->bake, material.kind), protocol_->bake.observer);
}

glm::dmat3 StimulusLibrary::display_from_frame(const FrameQuality& quality) const {
    if (quality.is_live())
        return display_from(PictureColours::rec709, protocol_->display);
    return protocol_->light.exposure *
           display_from(rendered_colours(protocol_->bake.observer), protocol_->display);
}

std::vector<int> StimulusLibrary::page_of_frame(const Condition& condition) const {
    std::vector<int> pages;
    for (int frame = 0; frame < protocol_->animation.frame_count; ++frame) {
        // Each ready-made frame is shown itself, even where two share a pose.
        pages.push_back(is_ready_made(condition) ? frame : poses_.pose_of({frame}).value);
    }
    return pages;
}

LinearImage StimulusLibrary::page(const Condition& condition, int page) const {
    LinearImage image;
    read_page(condition, page, image);
    return image;
}

const LinearImage& StimulusLibrary::read_page(const Condition& condition, int page, LinearImage& room) const {
    if (const FrameSequenceSettings* sequence = sequence_of(condition)) {
        read_linear_image(frame_file(*sequence, {page}), sequence->encoding, room);
        transform(room, sequence->exposure * display_from(colours_of(*sequence), protocol_->display));
        return room;
    }
    const FrameQuality& quality = qualities_[index_of(condition)];
    read_linear_image(frame_file_of(condition, quality, {page}), FrameEncoding::linear, room);
    transform(room, display_from_frame(quality));
    return room;
}

std::string StimulusLibrary::source_of(const Condition& condition) const {
    if (const FrameSequenceSettings* sequence = sequence_of(condition))
        return "frames " + sequence->files;
    const FrameQuality& quality = qualities_[index_of(condition)];
    if (quality.is_live())
        return "OpenGL preview";
    const BakeSettings settings = bake_settings(quality, protocol_->bake, material_of(condition).kind);
    return fmt::format("path traced, {}: {} samples, {}", name_of(quality.level), settings.samples,
                       protocol_->bake.observer == StandardObserver::cie2006 ? "CIE 2006" : "CIE 1931");
}

ContentHash StimulusLibrary::frames_hash(const Condition& condition) const {
    ContentHasher hasher;
    const auto& light = protocol_->display.characterisation;
    if (const FrameSequenceSettings* sequence = sequence_of(condition)) {
        for (int frame = 0; frame < protocol_->animation.frame_count; ++frame) {
            hasher.add(std::string_view(hash_of_file(frame_file(*sequence, {frame}))));
        }
        if (sequence->exposure != 1.0)
            hasher.add(sequence->exposure);
        if (sequence->colour_space == FrameColours::display)
            return hasher.finish();
        hasher.add(static_cast<int>(sequence->colour_space));
    } else {
        hasher.add(std::string_view(frame_key(condition, qualities_[index_of(condition)])));
        hasher.add(protocol_->light.exposure);
    }
    if (light)
        hasher.add(std::string_view(light->sha256));
    return hasher.finish();
}

std::filesystem::path StimulusLibrary::cached(std::string_view kind, const ContentHash& hash,
                                              int pose) const {
    return cache_ / kind / hash.substr(0, 24) /
           fmt::format("{:+010.5f}deg.exr", poses_.angles[static_cast<std::size_t>(pose)].value);
}

const FrameSequenceSettings* StimulusLibrary::sequence_of(const Condition& condition) const {
    return find_frames(*protocol_, condition.sculpture, condition.material);
}

const MaterialSettings& StimulusLibrary::material_of(const Condition& condition) const {
    return protocol_->materials[static_cast<std::size_t>(condition.material)];
}

std::size_t StimulusLibrary::index_of(const Condition& condition) const {
    return static_cast<std::size_t>(condition.sculpture) * protocol_->materials.size() +
           static_cast<std::size_t>(condition.material);
}

} // namespace overt
