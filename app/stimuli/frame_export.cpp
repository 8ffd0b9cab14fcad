#include "app/stimuli/frame_export.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/this_program.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/protocol/all_stimuli.h"
#include "render/bake/light_colour.h"
#include "render/signal/display_light.h"
#include "render/stimulus/cached_frame.h"
#include "render/stimulus/frame_description.h"
#include "render/stimulus/frame_files.h"

namespace overt {

namespace {

constexpr const char* key_name = "overt:key";

/// Changes whenever the same light would make other files.
constexpr int export_version = 2;

std::string unit_of(ExportedLight light, bool png16, StandardObserver observer) {
    const std::string times = "; multiplied by alpha, and by the exposure";
    switch (light) {
    case ExportedLight::display:
        return png16 ? "linear display light over the background, 65535 = the display's white, clipped"
                     : "linear display light, 0 = the display's black, 1 = its white" + times;
    case ExportedLight::xyz:
        return (observer == StandardObserver::cie2006 ? "XYZ_F of CIE 2006" : "CIE 1931 XYZ") +
               std::string(", Y = 1 is as bright as the display's white") + times;
    case ExportedLight::spectra:
        return "radiance, mean of each band of 10 nm about the wavelength named; the sum over the bands of "
               "radiance times the CIE 1931 y function is 1 where light is as bright as the display's white" +
               times;
    }
    return {};
}

std::vector<std::string> channels_of(ExportedLight light) {
    switch (light) {
    case ExportedLight::display:
        return {"R", "G", "B", "A"};
    case ExportedLight::xyz:
        return {"X", "Y", "Z", "A"};
    case ExportedLight::spectra:
        break;
    }
    std::vector<std::string> channels;
    for (int bin = 0; bin < spectral_bins; ++bin)
        channels.push_back(fmt::format("{:.0f}nm", first_bin_centre_nm + bin_width_nm * bin));
    channels.emplace_back("A");
    return channels;
}

/// Over the background, in 16 bits of linear light.
std::vector<std::uint16_t> codes_of(const ChannelPicture& picture, double background,
                                    ClippedPixels& clipped) {
    std::vector<std::uint16_t> codes;
    codes.reserve(picture.values.size() / 4 * 3);
    LinearImage image(picture.size_px);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float* value = &picture.values[4 * i];
        image.pixels[i] = {value[0], value[1], value[2], value[3]};
        for (int channel = 0; channel < 3; ++channel) {
            const double light = double{value[channel]} + (1.0 - double{value[3]}) * background;
            codes.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(light, 0.0, 1.0))));
        }
    }
    clipped = count_clipped(image, background);
    return codes;
}

} // namespace

FrameExport::FrameExport(const FrameExportOptions& options, const Protocol& protocol,
                         std::span<const Object> objects, const StimulusLibrary& library,
                         const FrameQuality& quality)
    : options_(&options), protocol_(&protocol), objects_(objects), library_(&library), quality_(&quality) {}

std::filesystem::path FrameExport::folder_of(const Stimulus& stimulus) const {
    return options_->folder / stimulus_name(*protocol_, stimulus, '_');
}

std::vector<std::filesystem::path> FrameExport::files_of(const BakeUnit& unit) const {
    const std::filesystem::path folder = folder_of(unit.stimulus);
    std::vector<std::filesystem::path> files;
    const Animation& motion = protocol_->motion_of(unit.stimulus);
    const int last = std::min(options_->frames.last, motion.frame_count - 1);
    for (int frame = options_->frames.first; frame <= last; ++frame) {
        if (is_same_pose(motion.pose_of({frame}), unit.pose))
            files.push_back(folder /
                            fmt::format("frame_{:04}.{}", frame, options_->is_png() ? "png" : "exr"));
    }
    return files;
}

ContentHash FrameExport::key_of(const BakeUnit& unit) const {
    ContentHasher hasher;
    hasher.add(export_version)
        .add(std::string_view(library_->cache().picture_key(unit.stimulus, *quality_, unit.pose.light)));
    add_object(hasher, unit.pose.object);
    hasher.add(static_cast<int>(options_->as)).add(static_cast<int>(options_->file));
    hasher.add(protocol_->light_of(unit.stimulus).exposure);
    if (options_->is_png())
        hasher.add(protocol_->display.background);
    const auto& light = protocol_->display.characterisation;
    if (options_->as == ExportedLight::display && light)
        hasher.add(std::string_view(light->sha256));
    return hasher.finish();
}

std::string FrameExport::key_in(const std::filesystem::path& file) const {
    if (!options_->is_png())
        return text_attribute(file, key_name);
    int error = 0;
    const auto text =
        read_whole_file(std::filesystem::path(file).replace_extension(".json"), most_text_bytes, error);
    const auto json = nlohmann::json::parse(text.value_or(""), nullptr, false);
    return json.is_object() ? json.value(key_name, "") : "";
}

bool FrameExport::has(const BakeUnit& unit) const {
    const ContentHash key = key_of(unit);
    const std::vector<std::filesystem::path> files = files_of(unit);
    return std::all_of(files.begin(), files.end(), [&](const std::filesystem::path& file) {
        return std::filesystem::exists(file) && key_in(file) == key;
    });
}

void FrameExport::refuse_to_replace(const std::vector<BakeUnit>& units) const {
    if (std::filesystem::exists(options_->folder) && !std::filesystem::is_directory(options_->folder))
        throw InputError(fmt::format("--out {}: is no folder", options_->folder.string()));
    if (options_->force)
        return;
    for (const BakeUnit& unit : units) {
        for (const std::filesystem::path& file : files_of(unit)) {
            if (std::filesystem::exists(file) && key_in(file) != key_of(unit)) {
                throw InputError(
                    fmt::format("{}: is there already and was made otherwise: give another --out, "
                                "or --overwrite to replace it",
                                file.string()));
            }
        }
    }
}

ChannelPicture FrameExport::picture_of(const BakeUnit& unit, const SpectralFrame* traced) const {
    ChannelPicture picture;
    picture.channels = channels_of(options_->as);
    if (options_->as == ExportedLight::spectra) {
        OVERT_EXPECTS(traced);
        picture.size_px = traced->size_px;
        picture.values.reserve(traced->alpha.size() * picture.channels.size());
        const auto exposure = static_cast<float>(protocol_->light_of(unit.stimulus).exposure);
        for (std::size_t i = 0; i < traced->alpha.size(); ++i) {
            const float factor = exposure * traced->alpha[i];
            for (std::size_t bin = 0; bin < spectral_bins; ++bin)
                picture.values.push_back(factor * traced->radiance[i * spectral_bins + bin]);
            picture.values.push_back(traced->alpha[i]);
        }
        return picture;
    }
    LinearImage image;
    library_->cache().read_frame(unit.stimulus, *quality_, unit.pose, image);
    transform(image, options_->as == ExportedLight::display
                         ? library_->cache().display_from_frame(unit.stimulus, *quality_)
                         : protocol_->light_of(unit.stimulus).exposure *
                               xyz_from(rendered_colours(protocol_->bake.observer)));
    picture.size_px = image.size_px;
    for (const glm::vec4& pixel : image.pixels)
        picture.values.insert(picture.values.end(), {pixel.x, pixel.y, pixel.z, pixel.w});
    return picture;
}

ImageAttributes FrameExport::attributes_of(const BakeUnit& unit) const {
    ImageAttributes attributes = describe_stimulus(*protocol_, objects_, unit.stimulus, unit.pose);
    for (auto& attribute :
         describe_tracing(*quality_, *protocol_, protocol_->material_of(unit.stimulus).kind))
        attributes.push_back(std::move(attribute));
    attributes.emplace_back("overt:exposure", fmt::format("{}", protocol_->light_of(unit.stimulus).exposure));
    const auto& light = protocol_->display.characterisation;
    if (options_->as == ExportedLight::display) {
        attributes.emplace_back("overt:display",
                                light ? light->display : "none measured: the primaries of Rec. 709");
        if (light)
            attributes.emplace_back("overt:characterisation_sha256", light->sha256);
    }
    attributes.emplace_back("overt:unit",
                            unit_of(options_->as, options_->is_png(), protocol_->bake.observer));
    attributes.emplace_back("overt:program",
                            fmt::format("overt {} {}", this_build().version, this_build().commit));
    attributes.emplace_back(key_name, key_of(unit));
    return attributes;
}

ClippedPixels FrameExport::write(const BakeUnit& unit, const SpectralFrame* traced) const {
    const ChannelPicture picture = picture_of(unit, traced);
    const ImageAttributes attributes = attributes_of(unit);
    ClippedPixels clipped;
    std::vector<std::uint16_t> codes;
    if (options_->is_png())
        codes = codes_of(picture, protocol_->display.background, clipped);
    for (const std::filesystem::path& file : files_of(unit)) {
        std::filesystem::create_directories(file.parent_path());
        if (!options_->is_png()) {
            write_exr(file, picture,
                      options_->file == ExportedFile::half_exr ? ExrNumbers::half : ExrNumbers::bits24,
                      attributes);
            continue;
        }
        nlohmann::ordered_json json;
        for (const auto& [name, value] : attributes)
            json[name] = value;
        json["overt:background"] = protocol_->display.background;
        json["overt:share_clipped_above"] = {clipped.share_above(0), clipped.share_above(1),
                                             clipped.share_above(2)};
        json["overt:share_clipped_below"] = {clipped.share_below(0), clipped.share_below(1),
                                             clipped.share_below(2)};
        // The sidecar last: with its key it says that the picture is whole.
        write_rgb16_png(file, picture.size_px, codes);
        write_whole_file(std::filesystem::path(file).replace_extension(".json"), json.dump(2) + "\n");
    }
    return clipped;
}

} // namespace overt
