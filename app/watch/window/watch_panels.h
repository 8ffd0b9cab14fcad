/// What stands in the window of the operator's view. Dear ImGui must have a frame under way.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/watch/live_saliency.h"
#include "app/watch/watched_session.h"
#include "app/watch/window/marks.h"
#include "app/watch/window/saliency_picture.h"
#include "devices/operator/operator_client.h"
#include "experiment/watch/view_text.h"

namespace overt {

/// Textures; 0 where there is none.
struct WatchPictures {
    std::vector<GLuint> stimuli = {}; ///< that are shown now, as SessionView::shown has them
    GLuint camera = 0;                ///< what the tracker's camera sees, instead
};

class WatchPanels {
  public:
    /// `client` takes the commands. All of it must outlive this.
    WatchPanels(OperatorClient& client, LiveSaliency& saliency, SaliencyPicture& surface)
        : client_(client), saliency_(saliency), surface_(surface) {}

    /// All of the window, `width` by `height` pixels. `delay_s`: from a sample's coming to its point in the
    /// window; nothing if it is not known.
    void draw(const ViewText& text, const WatchedSession& session, const WatchPictures& pictures,
              std::optional<double> delay_s, float width, float height);

    /// Gaze in the window that was drawn last, with what has come since: on the display and on the surface.
    std::vector<Mark> marks(const WatchedSession& session) const;

  private:
    /// Where pixels of something stand in the window.
    struct Drawn {
        glm::vec2 corner_px{0.0f}, size_px{0.0f};
        float scale = 0.0f; ///< 0: it was not drawn
    };
    void draw_display(const ViewText& text, const WatchedSession& session, const WatchPictures& pictures);
    void draw_saliency(const ViewText& text, const WatchedSession& session);
    void draw_figures(const ViewText& text, std::optional<double> delay_s);
    void draw_messages(const ViewText& text);
    void draw_commands(const ViewText& text);
    void draw_confirmation(const ViewText& text);
    void send(const OperatorCommand& command);

    OperatorClient& client_;
    LiveSaliency& saliency_;
    SaliencyPicture& surface_;
    Orbit orbit_;
    Drawn display_, surface_drawn_;
    bool of_trial_ = false; ///< the map shows the last trial's gaze alone
    std::optional<OperatorCommand> asked_;
    std::array<char, longest_note + 1> note_{};
    std::string says_;
};

} // namespace overt
