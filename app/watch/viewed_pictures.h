/// Small pictures of the stimulus that is shown, from the session's folder.
#pragma once

#include <optional>
#include <string>

#include "experiment/maps/light_pictures.h"
#include "experiment/watch/session_view.h"
#include "experiment/watch/view_text.h"

namespace overt {

/// Reads the file of a stimulus once, when its first picture is asked for.
class ViewedPictures {
  public:
    /// The picture that the frame of what is shown in a slot has; without squares where there is none, or
    /// none that can be read.
    const ViewedPicture& of(const SessionFacts& facts, const ViewedSlot& slot, const ViewedStimulus& shown);

  private:
    std::string file_;
    std::optional<LightPictures> light_;
    int number_ = -1;
    ViewedPicture picture_;
};

} // namespace overt
