/// The response boxes of a session, as the protocol names them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "devices/buttons/threaded_button_box.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/response_panel.h"
#include "experiment/protocol/protocol.h"

namespace overt {

class DisplayPlusPlus;

/// Opens the boxes of the protocol and gives a panel that asks them and `answering`; null if there is none to
/// ask. `display_box`: of the session, for a CB6; null if there is none. `tell`: what the operator should
/// know. All references, and what is pointed to, must outlive the panel. Throws DeviceError for a box that is
/// required and cannot be had, and InputError for a button that a box does not have.
std::unique_ptr<ResponsePanel> make_button_boxes(const Protocol& protocol, Clock& clock,
                                                 ResponsePanel* answering, DisplayPlusPlus* display_box,
                                                 const std::function<void(const std::string&)>& tell);

/// One of them, by itself, read on a thread of its own where that can be. Throws as make_button_boxes().
std::unique_ptr<ThreadedButtonBox> open_button_box(const ButtonBoxSettings& settings, Clock& clock,
                                                   DisplayPlusPlus* display_box);

/// Lines for an overview of the machine: devices that could be response boxes. Opens none.
std::vector<std::string> button_box_overview();

} // namespace overt
