#include "render/stimulus/stimulus_library.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/base/whole_file.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "render/signal/display_light.h"
#include "render/stimulus/background_picture.h"
#include "render/stimulus/cached_frame.h"
#include "render/stimulus/given_maps.h"
#include "render/stimulus/ready_made_frames.h"

namespace overt {

StimulusLibrary::StimulusLibrary(const GlContext& context, const Protocol& protocol,
                                 std::span<const Object> objects, std::filesystem::path cache)
    : protocol_(&protocol), cache_(protocol, objects, std::move(cache)), maps_(context, cache_),
      frames_(context, cache_, maps_) {
    take_frames(quality_of(protocol.bake.least(), protocol.bake));
}

void StimulusLibrary::take_frames(const FrameQuality& quality) {
    for (const Stimulus& stimulus : stimuli_in_slots(*protocol_))
        qualities_[stimulus] = quality;
}

glm::ivec2 StimulusLibrary::image_px(const Stimulus& stimulus) const {
    const ViewSettings& view = protocol_->view_of(stimulus);
    return {view.width_px, view.height_px};
}

void StimulusLibrary::prepare_frames(const Progress& progress, BakeQuality least) {
    for (const Stimulus& stimulus : stimuli_in_slots(*protocol_)) {
        if (const FrameSequenceSettings* sequence = cache_.sequence_of(stimulus))
            check_frame_sizes(*sequence, protocol_->motion_of(stimulus).frame_count, image_px(stimulus));
    }
    const std::vector<Stimulus> stimuli = cache_.rendered_stimuli();
    for (const Stimulus& stimulus : stimuli)
        cache_.require_mesh(stimulus);
    for (const BakeQuality level : traced_qualities)
        if (level >= least)
            frames_.add_up_what_is_there(stimuli, quality_of(level, protocol_->bake));
    if (const std::optional<FrameQuality> best = cache_.best_quality(stimuli, least)) {
        take_frames(*best);
        return;
    }
    const FrameQuality quality = quality_of(least, protocol_->bake);
    const std::vector<std::string> unsound = cache_.unsound_frames(stimuli, quality);
    if (least > BakeQuality::preview) {
        const FrameCount count = cache_.count_frames(stimuli, quality);
        const std::string file = protocol_->file.string();
        throw InputError(
            fmt::format("{}{}: this session needs frames of {} quality, and {} of {} are not baked "
                        "yet: run `overt bake {}{}` first (`overt check` says how long it "
                        "takes), or, for a trial run, be content with --quality preview{}",
                        unsound.empty() ? "" : fmt::format("{}\n", fmt::join(unsound, "\n")), file,
                        describe(quality), count.missing, count.all, file,
                        least == BakeQuality::standard ? "" : fmt::format(" --quality {}", name_of(least)),
                        protocol_->bake.quality ? ""
                                                : ". What people are shown at least is [bake] quality in the "
                                                  "protocol, which is \"standard\" where it is left out"));
    }
    for (const std::string& sentence : unsound)
        remarks_.push_back(sentence + ": it was made anew");
    frames_.make_frames(stimuli, quality, progress);
    take_frames(quality);
}

void StimulusLibrary::prepare_frames(const Stimulus& stimulus, const Progress& progress,
                                     std::optional<AnimationFrameIndex> only) {
    if (const FrameSequenceSettings* sequence = cache_.sequence_of(stimulus)) {
        check_frame_sizes(*sequence, protocol_->motion_of(stimulus).frame_count, image_px(stimulus));
        return;
    }
    cache_.require_mesh(stimulus);
    const std::span<const Stimulus> one(&stimulus, 1);
    const BakeQuality least = std::min(protocol_->bake.least(), BakeQuality::preview);
    for (const BakeQuality level : traced_qualities)
        frames_.add_up_what_is_there(one, quality_of(level, protocol_->bake));
    if (const std::optional<FrameQuality> best = cache_.best_quality(one, least)) {
        qualities_[stimulus] = *best;
        return;
    }
    qualities_[stimulus] = quality_of(least, protocol_->bake);
    frames_.make_frames(one, qualities_[stimulus], progress,
                        only ? std::optional(protocol_->motion_of(stimulus).pose_of(*only)) : std::nullopt);
}

const FrameQuality& StimulusLibrary::quality_of_frames(const Stimulus& stimulus) const {
    return qualities_.at(stimulus);
}

std::vector<int> StimulusLibrary::page_of_frame(const Stimulus& stimulus) const {
    const std::span<const int> picture_of = cache_.picture_of_frame(stimulus);
    std::vector<int> pages(picture_of.begin(), picture_of.end());
    // Each ready-made frame is shown itself, even where two share a pose.
    if (cache_.is_ready_made(stimulus))
        std::iota(pages.begin(), pages.end(), 0);
    return pages;
}

LinearImage StimulusLibrary::page(const Stimulus& stimulus, int page) const {
    LinearImage image;
    read_page(stimulus, page, image);
    return image;
}

LinearImage StimulusLibrary::page_on_screen(const Stimulus& stimulus, int page) const {
    LinearImage image = this->page(stimulus, page);
    const auto background = static_cast<float>(protocol_->display.background);
    for (glm::vec4& pixel : image.pixels)
        pixel = glm::vec4(glm::vec3(pixel) + (1.0f - pixel.w) * background, 1.0f);
    return image;
}

const LinearImage& StimulusLibrary::read_page(const Stimulus& stimulus, int page, LinearImage& room) const {
    const LinearImage& object = read_object(stimulus, page, room);
    if (is_displays_own(protocol_->background_of(stimulus)))
        return object;
    if (&object != &room)
        room = object;
    put_before(room, background_of(stimulus));
    return room;
}

const LinearImage& StimulusLibrary::background_of(const Stimulus& stimulus) const {
    const std::scoped_lock lock(backgrounds_mutex_);
    const auto [made, is_new] = backgrounds_.try_emplace({stimulus.background, stimulus.view});
    if (is_new)
        made->second =
            draw_background(protocol_->background_of(stimulus), image_px(stimulus), protocol_->display);
    return made->second;
}

LinearImage StimulusLibrary::object_on_page(const Stimulus& stimulus, int page) const {
    LinearImage image;
    read_object(stimulus, page, image);
    return image;
}

const LinearImage& StimulusLibrary::read_object(const Stimulus& stimulus, int page, LinearImage& room) const {
    if (const FrameSequenceSettings* sequence = cache_.sequence_of(stimulus)) {
        read_linear_image(frame_file(*sequence, {page}), sequence->encoding,
                          sequence->colour_space == FrameColours::rec709 ? FileColours::as_rec709
                                                                         : FileColours::as_they_stand,
                          room);
        transform(room, sequence->exposure * display_from(colours_of(*sequence), protocol_->display));
        return room;
    }
    const FrameQuality& quality = qualities_.at(stimulus);
    const Pose& pose = cache_.pictures_of(stimulus)[static_cast<std::size_t>(page)];
    cache_.read_frame(stimulus, quality, pose, room);
    transform(room, cache_.display_from_frame(stimulus, quality));
    return room;
}

std::filesystem::path StimulusLibrary::page_file(const Stimulus& stimulus, int page) const {
    if (const FrameSequenceSettings* sequence = cache_.sequence_of(stimulus))
        return frame_file(*sequence, {page});
    return cache_.frame_file_of(stimulus, qualities_.at(stimulus),
                                cache_.pictures_of(stimulus)[static_cast<std::size_t>(page)]);
}

std::string StimulusLibrary::source_of(const Stimulus& stimulus) const {
    if (const FrameSequenceSettings* sequence = cache_.sequence_of(stimulus))
        return "frames " + sequence->files;
    const FrameQuality& quality = qualities_.at(stimulus);
    if (quality.is_live())
        return "OpenGL preview";
    const BakeSettings settings = bake_settings(quality, protocol_->bake, cache_.material_of(stimulus).kind);
    return fmt::format("path traced, {}: {} samples, {}", name_of(quality.level), settings.samples,
                       protocol_->bake.observer == StandardObserver::cie2006 ? "CIE 2006" : "CIE 1931");
}

ContentHash StimulusLibrary::frames_hash(const Stimulus& stimulus) const {
    ContentHash object = object_pixels_hash(stimulus);
    if (object.empty() || is_displays_own(protocol_->background_of(stimulus)))
        return object;
    ContentHasher hasher;
    hasher.add(std::string_view(object)).add(std::string_view(hash_of_pixels(background_of(stimulus))));
    return hasher.finish();
}

ContentHash StimulusLibrary::object_pixels_hash(const Stimulus& stimulus) const {
    if (cache_.is_ready_made(stimulus))
        return object_hash(stimulus); // the files' bytes are in it
    const ContentHash pixels = cache_.pixels_hash(stimulus, qualities_.at(stimulus));
    if (pixels.empty())
        return {};
    ContentHasher hasher;
    hasher.add(std::string_view("pixels")).add(std::string_view(pixels));
    // Live frames have the exposure themselves.
    hasher.add(qualities_.at(stimulus).is_live() ? 1.0 : protocol_->light_of(stimulus).exposure);
    if (const auto& light = protocol_->display.characterisation)
        hasher.add(std::string_view(light->sha256));
    return hasher.finish();
}

std::string StimulusLibrary::renderer_of(const Stimulus& stimulus) const {
    return cache_.is_ready_made(stimulus) ? std::string()
                                          : cache_.renderer_of(stimulus, qualities_.at(stimulus));
}

ContentHash StimulusLibrary::made_from_hash(const Stimulus& stimulus) const {
    ContentHash object = object_hash(stimulus);
    const BackgroundSettings& background = protocol_->background_of(stimulus);
    if (is_displays_own(background))
        return object;
    ContentHasher hasher;
    hasher.add(std::string_view(object)).add(std::string_view(hash_of_background(background)));
    return hasher.finish();
}

ContentHash StimulusLibrary::object_hash(const Stimulus& stimulus) const {
    ContentHasher hasher;
    const auto& light = protocol_->display.characterisation;
    if (const FrameSequenceSettings* sequence = cache_.sequence_of(stimulus)) {
        for (int frame = 0; frame < protocol_->motion_of(stimulus).frame_count; ++frame) {
            hasher.add(std::string_view(hash_of_file(frame_file(*sequence, {frame}))));
        }
        if (sequence->exposure != 1.0)
            hasher.add(sequence->exposure);
        if (sequence->colour_space == FrameColours::display)
            return hasher.finish();
        hasher.add(static_cast<int>(sequence->colour_space));
    } else {
        hasher.add(std::string_view(cache_.frame_key(stimulus, qualities_.at(stimulus))));
        hasher.add(protocol_->light_of(stimulus).exposure);
    }
    if (light)
        hasher.add(std::string_view(light->sha256));
    return hasher.finish();
}

LightPictures StimulusLibrary::light_of(const Stimulus& stimulus) const {
    LightPictures light;
    light.image_px = image_px(stimulus);
    light.square_px = light_square_px(light.image_px);
    light.pictures = static_cast<int>(cache_.pictures_of(stimulus).size());
    light.luminance.resize(light.squares() * static_cast<std::size_t>(light.pictures));
    light.coverage.resize(light.luminance.size());
    const auto& measured = protocol_->display.characterisation;
    const glm::dvec3 shares = measured ? measured->luminance_shares() : glm::dvec3(0.2126, 0.7152, 0.0722);
    const std::vector<int> page_of = page_of_frame(stimulus);
    const std::span<const int> picture_of = cache_.picture_of_frame(stimulus);
    parallel_for(light.pictures, [&](int number) {
        const auto frame = std::ranges::find(picture_of, number) - picture_of.begin();
        const LinearImage picture = object_on_page(stimulus, page_of[static_cast<std::size_t>(frame)]);
        const glm::ivec2 size = light.size();
        const std::size_t begin = light.squares() * static_cast<std::size_t>(number);
        std::vector<double> luminance(light.squares()), coverage(light.squares());
        std::vector<int> pixels(light.squares());
        for (int y = 0; y < picture.size_px.y; ++y) {
            for (int x = 0; x < picture.size_px.x; ++x) {
                const auto square =
                    static_cast<std::size_t>(y / light.square_px * size.x + x / light.square_px);
                const glm::vec4& pixel = picture.at(x, y);
                // As it is shown: no channel is brighter than white. Colours are multiplied by alpha.
                luminance[square] += glm::dot(
                    shares, glm::dvec3(glm::clamp(glm::vec3(pixel), glm::vec3(0.0f), glm::vec3(pixel.a))));
                coverage[square] += static_cast<double>(pixel.a);
                ++pixels[square];
            }
        }
        for (std::size_t i = 0; i < light.squares(); ++i) {
            light.luminance[begin + i] =
                coverage[i] > 0.0 ? static_cast<float>(luminance[i] / coverage[i]) : 0.0f;
            light.coverage[begin + i] = static_cast<float>(coverage[i] / std::max(pixels[i], 1));
        }
    });
    return light;
}

std::optional<std::filesystem::path> StimulusLibrary::light_file(const Stimulus& stimulus, bool make) const {
    const FrameSequenceSettings* const sequence = cache_.sequence_of(stimulus);
    if (sequence && !has_alpha(frame_file(*sequence, {0})))
        return std::nullopt;
    const ContentHash frames = object_pixels_hash(stimulus);
    if (frames.empty() && !make)
        return std::nullopt;
    // The angles are not in the hash of ready-made frames.
    ContentHasher hasher;
    hasher.add(std::string_view(frames));
    for (const Pose& pose : cache_.pictures_of(stimulus))
        add_object(hasher, pose.object);
    const std::filesystem::path file = cache_.light_file(hasher.finish());
    if (!std::filesystem::exists(file)) {
        if (!make)
            return std::nullopt;
        std::filesystem::create_directories(file.parent_path());
        write_light_pictures(file, light_of(stimulus));
    }
    return file;
}

std::filesystem::path StimulusLibrary::first_frame_file(const Stimulus& stimulus) const {
    const int first = page_of_frame(stimulus).front();
    ContentHasher hasher;
    hasher.add(std::string_view(frames_hash(stimulus)));
    if (!cache_.is_ready_made(stimulus))
        add_object(hasher, cache_.pictures_of(stimulus).front().object);
    if (protocol_->display.background != 0.0)
        hasher.add(protocol_->display.background);
    std::filesystem::path file = cache_.first_frame_file(hasher.finish());
    if (!std::filesystem::exists(file)) {
        std::filesystem::create_directories(file.parent_path());
        write_srgb_png(file, page_on_screen(stimulus, first));
    }
    return file;
}

} // namespace overt
