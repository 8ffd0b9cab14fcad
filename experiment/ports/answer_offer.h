/// What an observer who does not see the screen is told of an answer: how each meaning is given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/attitude.h"

namespace overt {

/// A column of a match: its values in rising order, and how one goes through them.
struct OfferedAxis {
    std::vector<double> values;
    int start = 0;                    ///< index of the one that it stands at
    std::optional<double> reference;  ///< the value of the stimulus beside it
    std::string less, more;           ///< keys, by one value; empty: by the mouse alone
    std::string much_less, much_more; ///< keys, by `coarse` values; empty: there are none
    int coarse = 1;
};

struct AnswerOffer {
    std::string id, item, kind; ///< as in GivenAnswer
    /// Of a choice, or of the steps of a scale: what each means, in the order of `keys`.
    std::vector<std::string> values;
    std::vector<double> numbers;   ///< of a scale: of each step
    std::vector<std::string> keys; ///< that give them; empty: by the mouse alone
    /// Of a line and of a number.
    std::optional<double> low, high;
    double step = 0.0; ///< of a line: how far a press of "left" or "right" moves it; of a number its grid
    bool is_turned = false;        ///< "right" goes to the low end
    std::string accept_key;        ///< that makes it stand; empty: it stands at once
    std::optional<double> limit_s; ///< for how long presses count
    std::string correct;           ///< a value; empty: nobody knows
    /// Of a gauge, how it is turned now, and how the surface is where it stands; nothing if nobody knows.
    std::optional<Attitude> attitude = {}, true_attitude = {};
    double slant_per_px_deg = 0.0; ///< of a gauge that the mouse turns; 0: keys do
    std::vector<OfferedAxis> axes; ///< of a match, one for each column
};

} // namespace overt
