/// GLFW's keys as ours.
#pragma once

#include <string>

#include "render/window/window_context.h"

namespace overt {

/// The key of GLFW's number; `modifiers` as GLFW has them.
WindowKey window_key_of(int key, int modifiers) noexcept;

/// What is written on a key by the keyboard's layout ("7", "å"), or what it is called ("enter", "left shift",
/// "keypad 7", "f5"); "scancode 93" of one that neither tells. Main thread, while a window lives.
std::string key_name(const WindowKeyPress& press);
/// The same of a key by its numbers, without an allocation.
ShortName key_name_of(int glfw_key, int code) noexcept;

/// The modifiers that were held, as "shift" or "control+alt"; empty: none. A modifier's own press is not its
/// own company.
std::string modifier_names(const WindowKeyPress& press);

} // namespace overt
