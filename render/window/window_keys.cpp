#include "render/window/window_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace overt {

WindowKey window_key_of(int key, int modifiers) noexcept {
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12)
        return static_cast<WindowKey>(static_cast<int>(WindowKey::f1) + key - GLFW_KEY_F1);
    switch (key) {
    case GLFW_KEY_SPACE:
        return WindowKey::space;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
        return WindowKey::enter;
    case GLFW_KEY_ESCAPE:
        return WindowKey::escape;
    case GLFW_KEY_LEFT:
        return WindowKey::left;
    case GLFW_KEY_RIGHT:
        return WindowKey::right;
    case GLFW_KEY_UP:
        return WindowKey::up;
    case GLFW_KEY_DOWN:
        return WindowKey::down;
    case GLFW_KEY_TAB:
        return (modifiers & GLFW_MOD_SHIFT) != 0 ? WindowKey::back_tab : WindowKey::tab;
    case GLFW_KEY_BACKSPACE:
        return WindowKey::backspace;
    case GLFW_KEY_PAGE_UP:
        return WindowKey::page_up;
    case GLFW_KEY_PAGE_DOWN:
        return WindowKey::page_down;
    case GLFW_KEY_PAUSE:
        return WindowKey::pause;
    default:
        return WindowKey::other;
    }
}

} // namespace overt
