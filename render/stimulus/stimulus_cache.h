/// The rendered frames and hidden maps of a protocol's stimuli on disk: kept by what they were made from, so
/// so that they are found by what wants the same.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "experiment/base/content_hash.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/stimulus/object.h"
#include "experiment/trial.h"
#include "render/bake/spectral_frame.h"
#include "render/stimulus/cached_frame.h"
#include "render/stimulus/frame_key.h"
#include "render/stimulus/frame_quality.h"

namespace overt {

/// How many frames there are to be had of some stimuli, each counted once.
struct FrameCount {
    int all = 0, missing = 0;
};

/// Knows where everything lies and what is there, and writes and reads it; makes nothing. From any thread.
class StimulusCache {
  public:
    /// `protocol` and `objects` must outlive the cache. `folder`: for frames and maps; shared by all
    /// protocols, for each file is named by the hash of everything that made it. Throws InputError for a
    /// light probe that cannot be read.
    StimulusCache(const Protocol& protocol, std::span<const Object> objects, std::filesystem::path folder);

    const Protocol& protocol() const { return *protocol_; }
    std::span<const Object> objects() const { return objects_; }
    const Object& object_of(const Stimulus& stimulus) const {
        return objects_[static_cast<std::size_t>(stimulus.object)];
    }
    const MaterialSettings& material_of(const Stimulus& stimulus) const {
        return protocol_->material_of(stimulus);
    }
    const SceneView& scene_of(const Stimulus& stimulus) const {
        return object_of(stimulus).scene(stimulus.view);
    }

    /// The turns of the objects in all motions: what maps are of.
    const PoseTable& poses() const { return poses_; }

    /// The pictures that differ of a stimulus's motion, in order of first appearance.
    std::span<const Pose> pictures_of(const Stimulus& stimulus) const {
        return motions_[static_cast<std::size_t>(stimulus.motion)].pictures;
    }
    /// Which of them each animation frame shows.
    std::span<const int> picture_of_frame(const Stimulus& stimulus) const {
        return motions_[static_cast<std::size_t>(stimulus.motion)].picture_of_frame;
    }

    /// The ready-made frames of a stimulus, or null if it is to be rendered.
    const FrameSequenceSettings* sequence_of(const Stimulus& stimulus) const {
        return find_frames(*protocol_, stimulus);
    }
    bool is_ready_made(const Stimulus& stimulus) const { return sequence_of(stimulus) != nullptr; }

    /// All stimuli that are rendered.
    std::vector<Stimulus> rendered_stimuli() const;

    /// All stimuli whose object has a mesh or ready-made maps.
    std::vector<Stimulus> stimuli_with_surface() const;

    /// Throws InputError if a stimulus has neither a mesh to render nor [[frames]].
    void require_mesh(const Stimulus& stimulus) const;

    /// Pictures of which there is no frame of that quality. Stimuli may share some: those of two motions that
    /// have poses in common.
    std::vector<Pose> missing_frames(const Stimulus& stimulus, const FrameQuality& quality) const;

    /// Whether there is a frame, whole, and of what its name says.
    bool has_frame(const Stimulus& stimulus, const FrameQuality& quality, const Pose& pose) const;

    /// "FILE is not whole", of files that lie where frames of these stimuli should and are none.
    std::vector<std::string> unsound_frames(std::span<const Stimulus> stimuli,
                                            const FrameQuality& quality) const;

    /// Reads a frame as it lies in its file, and compares it with what the file says of it. Throws InputError
    /// (cached_frame.h).
    void read_frame(const Stimulus& stimulus, const FrameQuality& quality, const Pose& pose,
                    LinearImage& into) const;

    FrameCount count_frames(std::span<const Stimulus> stimuli, const FrameQuality& quality) const;

    /// The best quality of which every frame of these stimuli is there, if it is no less than `least`.
    std::optional<FrameQuality> best_quality(std::span<const Stimulus> stimuli, BakeQuality least) const;

    /// A frame's file: linear light without exposure, in rendered_colours(). Live ones are in Rec. 709 and
    /// have the exposure.
    std::filesystem::path frame_file_of(const Stimulus& stimulus, const FrameQuality& quality,
                                        const Pose& pose) const;

    /// Everything that makes a stimulus's picture under a turn of its light, but the object's angle.
    ContentHash picture_key(const Stimulus& stimulus, const FrameQuality& quality, Degrees light_turn) const;

    /// Everything that makes a stimulus's frames but the object's angles.
    ContentHash frame_key(const Stimulus& stimulus, const FrameQuality& quality) const;

    /// Of the pixels of a stimulus's frames, in the order of its pictures, with their poses; empty while one
    /// of them is not there. Throws InputError.
    ContentHash pixels_hash(const Stimulus& stimulus, const FrameQuality& quality) const;

    /// What OpenGL said of its renderer when it drew a stimulus's live frames: several, where it was not
    /// always the same. Empty for others.
    std::string renderer_of(const Stimulus& stimulus, const FrameQuality& quality) const;

    /// What turns a stimulus's frame file into the display's light; the exposure is in it.
    glm::dmat3 display_from_frame(const Stimulus& stimulus, const FrameQuality& quality) const;

    /// Writes a live frame. `renderer`: what OpenGL says of it. Throws RecordError.
    void store_live(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality,
                    const LinearImage& image, const std::string& renderer) const;

    /// The stimuli whose traced frames are added up for this one's, in the order of LightSettings::sum; none
    /// where its light is no sum.
    std::vector<Stimulus> parts_of(const Stimulus& stimulus) const;

    /// Whether the frames of all its parts are there, of a stimulus whose light is a sum.
    bool can_add_up(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality) const;

    /// Adds them up and writes the sum. Throws InputError for a frame that is not whole, RecordError.
    void add_up(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality) const;

    /// Writes a traced frame, which must be complete. Throws RecordError.
    void store(const Stimulus& stimulus, const Pose& pose, const FrameQuality& quality,
               const SpectralFrame& frame) const;

    /// The object has no mesh, but ready-made maps.
    bool has_given_maps(int object) const;

    /// A map's file; only for an object with a mesh, or ready-made maps.
    std::filesystem::path map_file(const ViewedObject& viewed, PoseIndex pose) const;

    /// Where the small pictures of the light of frames with this hash lie: see light_pictures.h.
    std::filesystem::path light_file(const ContentHash& frames) const {
        // The number changes whenever the pictures of the same frames come out differently.
        return folder_ / "light" / (frames.substr(0, 24) + "-v2.exr");
    }

    /// Where the first frame of frames with this hash lies, for looking at.
    std::filesystem::path first_frame_file(const ContentHash& frame) const {
        return folder_ / "first_frames" / (frame.substr(0, 24) + ".png");
    }

    /// Whether there is a map of an object with a mesh, whole, and of what its name says.
    bool has_map(const ViewedObject& viewed, PoseIndex pose) const;

    /// Reads it. Throws InputError, also for a map of something else.
    TriangleMap read_map(const ViewedObject& viewed, PoseIndex pose) const;

    /// The box of an object with ready-made maps, and where the camera stood: the field of view is 0 if the
    /// maps do not say. The maps must be there (MapMaker).
    SceneView scene_of_given_maps(const ViewedObject& viewed) const;

    /// All maps of an object with a mesh in a view. They must be there.
    CoordinateMaps maps_of(const ViewedObject& viewed) const;

  private:
    struct Pictures {
        std::vector<Pose> pictures;
        std::vector<int> picture_of_frame;
    };
    FrameIdentity identity_of(const Stimulus& stimulus, const FrameQuality& quality, const Pose& pose) const;
    bool is_frame(const std::filesystem::path& file, const FrameIdentity& identity,
                  const FrameQuality& quality) const;
    static Pictures pictures_of_motion(const Animation& motion);
    std::filesystem::path file_of(std::string_view kind, const ContentHash& hash,
                                  const ObjectPose& object) const;

    const Protocol* protocol_;
    std::span<const Object> objects_;
    std::filesystem::path folder_;
    PoseTable poses_;
    std::vector<Pictures> motions_;
    std::vector<Surroundings> lights_;
};

} // namespace overt
