/// All stimuli of a protocol, frame by frame, with their hidden maps: drawn once, kept by what they were made
/// from.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "experiment/analysis/coordinate_maps.h"
#include "experiment/content_hash.h"
#include "experiment/sculpture.h"
#include "render/coordinate_pass.h"
#include "render/page_presenter.h"
#include "render/stimulus_renderer.h"

namespace overt {

/// Told how far a longer piece of work is.
using Progress = std::function<void(std::string_view what, int done, int total)>;

class StimulusLibrary final : public FrameSource {
  public:
    /// `protocol` and `sculptures` must outlive the library. `cache`: folder for frames and maps; shared by
    /// all protocols, for each file is named by the hash of everything that made it.
    StimulusLibrary(const GlContext& context, const Protocol& protocol, std::span<const Sculpture> sculptures,
                    std::filesystem::path cache);

    /// Draws whatever frames the cache lacks, and checks the size of ready-made ones. Throws InputError,
    /// GraphicsError, RecordError.
    void prepare_frames(const Progress& progress);
    void prepare_frames(const Condition& condition, const Progress& progress);

    /// Brings ready-made maps (see given_maps.h) into the cache as maps of coordinates. Throws as
    /// read_given_map does.
    void prepare_given_maps(const Progress& progress);

    /// Draws whatever maps the cache lacks, of all sculptures with a mesh, or of one. Throws as above; an
    /// object that is nowhere in the picture is an InputError.
    void prepare_maps(const Progress& progress);
    void prepare_maps(int sculpture, const Progress& progress);

    std::vector<int> page_of_frame(const Condition& condition) const override;
    LinearImage page(const Condition& condition, int page) const override;
    void read_page(const Condition& condition, int page, LinearImage& into) const override;

    const PoseTable& poses() const { return poses_; }
    bool is_ready_made(const Condition& condition) const { return sequence_of(condition) != nullptr; }

    /// Where the pictures of a stimulus come from, in words.
    std::string source_of(const Condition& condition) const;
    /// Of everything that made its frames, the display's characterisation included; for ready-made ones, of
    /// the files' bytes.
    ContentHash frames_hash(const Condition& condition) const;

    /// The sculpture has no mesh, but ready-made maps.
    bool has_given_maps(int sculpture) const;

    /// The box of a sculpture with ready-made maps, and where the camera stood: the field of view is 0 if the
    /// maps do not say. prepare_given_maps() must have been called.
    SceneView scene_of_given_maps(int sculpture) const;

    /// The map's file in the cache; only for a sculpture with a mesh, or ready-made maps.
    std::filesystem::path map_file(int sculpture, PoseIndex pose) const;
    /// All maps of a sculpture. prepare_maps() must have been called.
    CoordinateMaps maps_of(int sculpture) const;

    /// Draws one pose anew, past the cache: for a look and for measurements.
    TriangleMap draw_map(int sculpture, PoseIndex pose);

  private:
    const FrameSequenceSettings* sequence_of(const Condition& condition) const;
    /// Of everything that made what was drawn, which is the same for all displays.
    ContentHash drawn_hash(const Condition& condition) const;
    std::filesystem::path page_file(const Condition& condition, int page) const;
    std::filesystem::path cached(std::string_view kind, const ContentHash& hash, int pose) const;
    const MeshBuffers& buffers_of(int sculpture, bool for_light);

    const GlContext* context_;
    const Protocol* protocol_;
    std::span<const Sculpture> sculptures_;
    std::filesystem::path cache_;
    PoseTable poses_;
    ContentHash light_hash_;
    std::optional<StimulusRenderer> renderer_;
    std::optional<CoordinatePass> coordinate_pass_;
    // The card holds one sculpture at a time.
    std::optional<MeshBuffers> buffers_;
    int buffered_sculpture_ = -1;
    bool buffered_for_light_ = false;
};

} // namespace overt
