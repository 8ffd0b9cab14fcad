/// The operator's view as text, for a terminal.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "experiment/watch/session_view.h"

namespace overt {

/// A picture of the stimulus that is shown, small.
struct ViewedPicture {
    int width = 0, height = 0;    ///< squares; 0: there is none
    std::vector<float> lightness; ///< row by row from the top, 0 black … 1 white
};

/// Of all that is shown, in words; each line ends with a newline and holds less than `columns` characters.
struct ViewText {
    const SessionFacts& facts;
    const SessionView& view;
    const std::deque<ViewedEvent>& events; ///< the newest last
    const std::deque<ViewedGaze>& gaze;    ///< likewise
    const ViewedPicture& picture;
    bool is_silent = false;   ///< the session has said nothing for seconds
    std::string surface = {}; ///< what gaze meets on the object, in words; empty if that is not known
    std::string areas = {};   ///< which shares of the gaze on the object its areas have, in words; or empty
    bool is_camera = false;   ///< the picture is what the tracker's camera sees
    int pictured = 0;         ///< whose the picture is: an index into SessionView::shown
};

/// Progress, time, quality, tracker, answers: a line for each.
std::vector<std::string> figures_of(const ViewText& of);

/// The whole view: figures, the picture with gaze on it ('o' newest, '.' before), the last messages and what
/// is asked. `rows` of the terminal.
std::string screen_of(const ViewText& of, int columns, int rows);

/// One line for where no screen is: what a log of the session wants.
std::string summary_of(const ViewText& of);

/// "1 in this trial, 3 in all", or "unproven".
std::string missed_text(const SessionFacts& facts, const SessionView& view);

/// "3 min 05 s"; "-" for nothing.
std::string duration_text(std::optional<double> seconds);

} // namespace overt
