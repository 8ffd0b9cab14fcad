/// What stands in the window of the operator's view. Dear ImGui must have a frame under way.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "devices/operator/operator_client.h"
#include "experiment/watch/view_text.h"

namespace overt {

class WatchPanels {
  public:
    /// `client` takes the commands, and must outlive this.
    explicit WatchPanels(OperatorClient& client) : client_(client) {}

    /// All of the window, `width` by `height` pixels. `picture`: the texture of the stimulus that is shown,
    /// as Dear ImGui's back end names it; null if there is none.
    void draw(const ViewText& text, void* picture, float width, float height);

  private:
    void draw_stimulus(const ViewText& text, void* picture);
    void draw_figures(const ViewText& text);
    void draw_messages(const ViewText& text);
    void draw_commands(const ViewText& text);
    void draw_confirmation(const ViewText& text);
    void send(const OperatorCommand& command);

    OperatorClient& client_;
    std::optional<OperatorCommand> asked_;
    std::array<char, longest_note + 1> note_{};
    std::string says_;
};

} // namespace overt
