/// Rendered frames, numbered, in files that other programs read.
#pragma once

#include <filesystem>
#include <optional>

#include "app/stimuli/bake_plan.h"
#include "render/image/gamut.h"
#include "render/stimulus/frame_files.h"

namespace overt {

/// What the numbers in the files are: the display's linear light (the default), XYZ, or 31 bins of radiance.
enum class ExportedLight { display, xyz, spectra };

/// EXR of floats of 24 bits, EXR of half floats, or 16-bit PNG, the last of display light only.
enum class ExportedFile { exr, half_exr, png16 };

struct FrameExportOptions {
    std::filesystem::path folder;
    ExportedLight as = ExportedLight::display;
    ExportedFile file = ExportedFile::exr;
    bool force = false; ///< replace files that are there and are something else
    FrameRange frames;

    bool is_png() const { return file == ExportedFile::png16; }
};

/// Writes FOLDER/OBJECT_MATERIAL/frame_NNNN.exr, a file for each frame of the animation, with everything
/// that made it in its header; with png16 .png with a .json beside each.
class FrameExport {
  public:
    /// All must outlive it.
    FrameExport(const FrameExportOptions& options, const Protocol& protocol, std::span<const Object> objects,
                const StimulusLibrary& library, const FrameQuality& quality);

    /// Whether the files of a unit are there, whole and made of the very same.
    bool has(const BakeUnit& unit) const;

    /// Where a stimulus's files go.
    std::filesystem::path folder_of(const Stimulus& stimulus) const;

    /// Throws InputError, naming the first, if a file of these units is there and is something else.
    void refuse_to_replace(const std::vector<BakeUnit>& units) const;

    /// Writes the files of a unit: from `traced` if given, which spectra need, or else from the library's
    /// cache. From several threads at once, for different units. Gives what was clipped of a PNG. Throws
    /// RecordError, InputError.
    ClippedPixels write(const BakeUnit& unit, const SpectralFrame* traced) const;

  private:
    std::vector<std::filesystem::path> files_of(const BakeUnit& unit) const;
    ContentHash key_of(const BakeUnit& unit) const;
    std::string key_in(const std::filesystem::path& file) const;
    ChannelPicture picture_of(const BakeUnit& unit, const SpectralFrame* traced) const;
    ImageAttributes attributes_of(const BakeUnit& unit) const;

    const FrameExportOptions* options_;
    const Protocol* protocol_;
    std::span<const Object> objects_;
    const StimulusLibrary* library_;
    const FrameQuality* quality_;
};

} // namespace overt
