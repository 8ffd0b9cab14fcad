/// What the buttons of a response box mean, as an experimenter writes it.
#pragma once

#include <string>
#include <string_view>

#include "experiment/ports/response_panel.h"

namespace overt {

/// "1 next", "A answer gold", "f pause".
struct ButtonMeaning {
    std::string button; ///< as the box calls it, see ButtonBox::button_name()
    std::string words;  ///< what it means, as it was written
    ResponsePress::Key key = ResponsePress::Key::next;
    char32_t character = 0;  ///< of a digit, which chooses a reason
    std::string answer = {}; ///< to the question of a trial; then `key` is next
};

/// Of the observer: next, back, yes, no, and "answer" with the words of the answer. Of the operator: pause,
/// recalibrate, repeat, reject, skip, abort, yes, no, and the digits 1 to 9. Throws InputError for anything
/// else, naming what there is.
ButtonMeaning parse_button_meaning(std::string_view text, bool is_operators);

} // namespace overt
