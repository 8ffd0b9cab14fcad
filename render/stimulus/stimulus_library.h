/// All stimuli of a protocol, frame by frame, with their hidden maps: drawn once, kept by what they were made
/// from.
#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <span>
#include <string>

#include "experiment/base/content_hash.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/stimulus/sculpture.h"
#include "render/presenter/page_presenter.h"
#include "render/signal/display_light.h"
#include "render/stimulus/coordinate_pass.h"
#include "render/stimulus/frame_quality.h"
#include "render/stimulus/frame_tracer.h"
#include "render/stimulus/stimulus_renderer.h"

namespace overt {

/// Told how far a longer piece of work is: `done` of `total` pieces, and which share of the time they are
/// thought to take. What it throws ends the work; what was finished by then is kept.
using Progress = std::function<void(std::string_view what, int done, int total, double share)>;

class StimulusLibrary final : public FrameSource {
  public:
    /// `protocol` and `sculptures` must outlive the library. `cache`: folder for frames and maps; shared by
    /// all protocols, for each file is named by the hash of everything that made it.
    StimulusLibrary(const GlContext& context, const Protocol& protocol, std::span<const Sculpture> sculptures,
                    std::filesystem::path cache);

    /// For a session: finds the best quality of which the cache has all frames of all stimuli, and is content
    /// with no less than `least`, or else than [bake] asks for. If there is none, previews and live frames
    /// are made now; what should be better is an InputError that says how to bake it. Checks the size of
    /// ready-made frames. Throws InputError, GraphicsError, RecordError.
    void prepare_frames(const Progress& progress, std::optional<BakeQuality> least = {});

    /// For a look at one stimulus: the best there is of it, or else a preview. Throws likewise.
    void prepare_frames(const Condition& condition, const Progress& progress);

    /// Has page() give frames of this quality of all stimuli that are not ready-made. They have to be there.
    void take_frames(const FrameQuality& quality) { qualities_.assign(qualities_.size(), quality); }

    /// The best quality of which the cache has every frame of every stimulus, no less than [bake] asks for.
    std::optional<FrameQuality> quality_of_session() const {
        return best_quality(rendered_stimuli(), protocol_->bake.quality);
    }

    /// The frames that page() gives of a stimulus that is not ready-made.
    const FrameQuality& quality_of_frames(const Condition& condition) const;

    /// All stimuli that are rendered.
    std::vector<Condition> rendered_stimuli() const;

    /// Poses of which the cache has no frame of that quality.
    std::vector<PoseIndex> missing_frames(const Condition& condition, const FrameQuality& quality) const;

    /// A frame in the cache: linear light without exposure, in rendered_colours(). Live ones are in Rec. 709
    /// and have the exposure.
    std::filesystem::path frame_file_of(const Condition& condition, const FrameQuality& quality,
                                        PoseIndex pose) const;

    /// Everything that makes a stimulus's frames but the angle.
    ContentHash frame_key(const Condition& condition, const FrameQuality& quality) const;

    /// What turns a cached frame into the display's light; the exposure is in it.
    glm::dmat3 display_from_frame(const FrameQuality& quality) const;

    /// Traces one frame, drawing its map before if the cache lacks it. Not complete if `progress` stopped it.
    SpectralFrame trace(const Condition& condition, PoseIndex pose, const FrameQuality& quality,
                        const BakeProgress& progress);

    /// Puts a traced frame into the cache. From any thread.
    void store(const Condition& condition, PoseIndex pose, const FrameQuality& quality,
               const SpectralFrame& frame) const;

    /// Brings ready-made maps (see given_maps.h) into the cache as maps of coordinates. Throws as
    /// read_given_map does.
    void prepare_given_maps(const Progress& progress);

    /// Draws whatever maps the cache lacks, of all sculptures with a mesh, or of one. Throws as above; an
    /// object that is nowhere in the picture is an InputError.
    void prepare_maps(const Progress& progress);
    void prepare_maps(int sculpture, const Progress& progress);

    std::vector<int> page_of_frame(const Condition& condition) const override;
    LinearImage page(const Condition& condition, int page) const override;
    const LinearImage& read_page(const Condition& condition, int page, LinearImage& room) const override;

    const PoseTable& poses() const { return poses_; }
    bool is_ready_made(const Condition& condition) const { return sequence_of(condition) != nullptr; }

    /// Where the pictures of a stimulus come from, in words.
    std::string source_of(const Condition& condition) const;
    /// Of everything that made its frames, the display's characterisation included; for ready-made ones, of
    /// the files' bytes.
    ContentHash frames_hash(const Condition& condition) const;

    /// Throws InputError if a stimulus has neither a mesh to render nor [[frames]].
    void require_mesh(const Condition& condition) const;

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
    const MaterialSettings& material_of(const Condition& condition) const;
    std::size_t index_of(const Condition& condition) const;
    bool is_complete(std::span<const Condition> conditions, const FrameQuality& quality) const;
    std::optional<FrameQuality> best_quality(std::span<const Condition> conditions, BakeQuality least) const;
    void make_frames(std::span<const Condition> conditions, const FrameQuality& quality,
                     const Progress& progress);
    void draw_live_frame(const Condition& condition, PoseIndex pose, std::future<void>& writing);
    bool draw_missing_map(int sculpture, PoseIndex pose);
    std::filesystem::path cached(std::string_view kind, const ContentHash& hash, int pose) const;
    const MeshBuffers& buffers_of(int sculpture, bool for_light);

    const GlContext* context_;
    const Protocol* protocol_;
    std::span<const Sculpture> sculptures_;
    std::filesystem::path cache_;
    PoseTable poses_;
    ContentHash surroundings_;
    std::vector<FrameQuality> qualities_; ///< of each stimulus's frames
    FrameTracer tracer_;
    std::optional<StimulusRenderer> renderer_;
    int live_material_ = -1; ///< that the renderer is prepared for
    std::optional<CoordinatePass> coordinate_pass_;
    // The card holds one sculpture at a time.
    std::optional<MeshBuffers> buffers_;
    int buffered_sculpture_ = -1;
    bool buffered_for_light_ = false;
};

} // namespace overt
