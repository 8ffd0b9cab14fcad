/// The hidden pass while the stimulus is on the screen: each pose that is lit for the first time is drawn
/// once more, out of sight, and read back without waiting.
#pragma once

#include <memory>
#include <vector>

#include "experiment/maps/triangle_map.h"
#include "experiment/ports/presentation_listener.h"
#include "experiment/ports/presenter.h"
#include "experiment/stimulus/object.h"
#include "render/gl/pixel_readback.h"
#include "render/stimulus/coordinate_pass.h"

namespace overt {

/// A map that was made while its frame was shown.
struct LiveMap {
    ViewedObject viewed;
    PoseIndex pose;
    TriangleMap map;
};

/// Used on the session's thread, where the context is current. Between a presentation's first and last flip
/// it allocates and throws nothing, and never waits for the card.
class LiveMaps final : public PresentationListener {
  public:
    /// `protocol`, whose slots are lit, and `objects` must outlive this. Uploads all meshes. Throws
    /// GraphicsError, or InputError as depth_range does.
    LiveMaps(const GlContext& context, const Protocol& protocol, std::span<const Object> objects,
             const PoseTable& poses);

    void presentation_begins(const Trial& lit, int show) noexcept override;
    void flipped(const FlipRecord& flip) noexcept override;
    void slot_flipped(const SlotFlip& flip) noexcept override;
    /// Ends a presentation: waits for what is still under way.
    void screen_shown(const Screen& screen, SessionTime onset) noexcept override;

    /// The maps finished since the last call, to be written down. Each pose of an object in a view comes
    /// once.
    std::vector<LiveMap> take_finished();

  private:
    enum class State : std::uint8_t { missing, under_way, done };
    /// What draws images of one size.
    struct Pass;
    /// An object in a view.
    struct Figure {
        ViewedObject viewed;
        glm::ivec2 image_px{0};
        Pass* pass = nullptr;
        const MeshBuffers* buffers = nullptr;    ///< null without a mesh
        std::vector<glm::mat4> clip_from_object; ///< by pose
        std::vector<State> states;               ///< by pose
        std::vector<TriangleMap> maps;           ///< by pose; memory only while the object is being mapped
    };
    struct Read {
        std::unique_ptr<PixelReadback> pixels;
        Figure* figure = nullptr;
        int pose = 0;
    };
    struct Pass {
        CoordinatePass drawing;
        std::vector<Read> reads;
    };
    Pass& pass_of(const GlContext& context, glm::ivec2 image_px);
    void collect(bool wait) noexcept;
    void make_ready(Figure& figure) noexcept;
    void draw(Figure& figure, PoseIndex pose) noexcept;
    Figure& figure_of(const ViewedObject& viewed) noexcept {
        return figures_[static_cast<std::size_t>(viewed.object) * views_ +
                        static_cast<std::size_t>(viewed.view)];
    }

    const Protocol* protocol_;
    std::vector<std::unique_ptr<Pass>> passes_;
    std::size_t views_ = 1;                             ///< at all sizes
    std::vector<std::unique_ptr<MeshBuffers>> buffers_; ///< by object
    std::vector<Figure> figures_;                       ///< by object, then by view
    std::vector<Figure*> lit_; ///< on the screen, in the order of the trial; room for all slots
};

} // namespace overt
