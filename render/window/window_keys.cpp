#include "render/window/window_keys.h"

#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace overt {

WindowKey window_key_of(int key, int modifiers) noexcept {
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12)
        return static_cast<WindowKey>(static_cast<int>(WindowKey::f1) + key - GLFW_KEY_F1);
    if (key == GLFW_KEY_TAB)
        return (modifiers & GLFW_MOD_SHIFT) != 0 ? WindowKey::back_tab : WindowKey::tab;
    constexpr std::pair<int, WindowKey> keys[] = {{GLFW_KEY_SPACE, WindowKey::space},
                                                  {GLFW_KEY_ENTER, WindowKey::enter},
                                                  {GLFW_KEY_KP_ENTER, WindowKey::enter},
                                                  {GLFW_KEY_ESCAPE, WindowKey::escape},
                                                  {GLFW_KEY_LEFT, WindowKey::left},
                                                  {GLFW_KEY_RIGHT, WindowKey::right},
                                                  {GLFW_KEY_UP, WindowKey::up},
                                                  {GLFW_KEY_DOWN, WindowKey::down},
                                                  {GLFW_KEY_BACKSPACE, WindowKey::backspace},
                                                  {GLFW_KEY_PAGE_UP, WindowKey::page_up},
                                                  {GLFW_KEY_PAGE_DOWN, WindowKey::page_down},
                                                  {GLFW_KEY_PAUSE, WindowKey::pause}};
    for (const auto& [number, meant] : keys)
        if (number == key)
            return meant;
    return WindowKey::other;
}

} // namespace overt
