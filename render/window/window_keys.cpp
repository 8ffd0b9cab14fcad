#include "render/window/window_keys.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace overt {

namespace {

/// Keys that write nothing that could be their name.
constexpr std::pair<int, std::string_view> called[] = {{GLFW_KEY_SPACE, "space"},
                                                       {GLFW_KEY_ESCAPE, "escape"},
                                                       {GLFW_KEY_ENTER, "enter"},
                                                       {GLFW_KEY_TAB, "tab"},
                                                       {GLFW_KEY_BACKSPACE, "backspace"},
                                                       {GLFW_KEY_INSERT, "insert"},
                                                       {GLFW_KEY_DELETE, "delete"},
                                                       {GLFW_KEY_RIGHT, "right"},
                                                       {GLFW_KEY_LEFT, "left"},
                                                       {GLFW_KEY_DOWN, "down"},
                                                       {GLFW_KEY_UP, "up"},
                                                       {GLFW_KEY_PAGE_UP, "page up"},
                                                       {GLFW_KEY_PAGE_DOWN, "page down"},
                                                       {GLFW_KEY_HOME, "home"},
                                                       {GLFW_KEY_END, "end"},
                                                       {GLFW_KEY_CAPS_LOCK, "caps lock"},
                                                       {GLFW_KEY_SCROLL_LOCK, "scroll lock"},
                                                       {GLFW_KEY_NUM_LOCK, "num lock"},
                                                       {GLFW_KEY_PRINT_SCREEN, "print screen"},
                                                       {GLFW_KEY_PAUSE, "pause"},
                                                       {GLFW_KEY_KP_DECIMAL, "keypad ."},
                                                       {GLFW_KEY_KP_DIVIDE, "keypad /"},
                                                       {GLFW_KEY_KP_MULTIPLY, "keypad *"},
                                                       {GLFW_KEY_KP_SUBTRACT, "keypad -"},
                                                       {GLFW_KEY_KP_ADD, "keypad +"},
                                                       {GLFW_KEY_KP_ENTER, "keypad enter"},
                                                       {GLFW_KEY_KP_EQUAL, "keypad ="},
                                                       {GLFW_KEY_LEFT_SHIFT, "left shift"},
                                                       {GLFW_KEY_LEFT_CONTROL, "left control"},
                                                       {GLFW_KEY_LEFT_ALT, "left alt"},
                                                       {GLFW_KEY_LEFT_SUPER, "left super"},
                                                       {GLFW_KEY_RIGHT_SHIFT, "right shift"},
                                                       {GLFW_KEY_RIGHT_CONTROL, "right control"},
                                                       {GLFW_KEY_RIGHT_ALT, "right alt"},
                                                       {GLFW_KEY_RIGHT_SUPER, "right super"},
                                                       {GLFW_KEY_MENU, "menu"}};

/// A modifier's own keys, left and right, and its bit.
struct Modifier {
    int bit, left_key, right_key;
    std::string_view name;
};
constexpr Modifier modifiers_held[] = {
    {GLFW_MOD_SHIFT, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, "shift"},
    {GLFW_MOD_CONTROL, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, "control"},
    {GLFW_MOD_ALT, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT, "alt"},
    {GLFW_MOD_SUPER, GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER, "super"}};

} // namespace

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

std::string key_name(const WindowKeyPress& press) {
    return std::string(key_name_of(press.glfw_key, press.code).view());
}

ShortName key_name_of(int key, int code) noexcept {
    for (const auto& [number, name] : called)
        if (number == key)
            return name;
    const auto numbered = [](std::string_view words, int number) {
        std::array<char, ShortName::capacity> name{};
        char* const end = std::copy(words.begin(), words.end(), name.begin());
        return ShortName({name.data(), std::to_chars(end, name.data() + name.size(), number).ptr});
    };
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25)
        return numbered("f", 1 + key - GLFW_KEY_F1);
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9)
        return numbered("keypad ", key - GLFW_KEY_KP_0);
    const char* const written = glfwGetKeyName(key, code);
    if (written && *written)
        return ShortName(written);
    // Of the layout of an American keyboard, where nothing is known of this one's.
    if (key > GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT) {
        const char letter = static_cast<char>(std::tolower(key));
        return ShortName({&letter, 1});
    }
    return numbered("scancode ", code);
}

std::string modifier_names(const WindowKeyPress& press) {
    std::string names;
    for (const Modifier& modifier : modifiers_held) {
        const bool is_itself = press.glfw_key == modifier.left_key || press.glfw_key == modifier.right_key;
        if ((press.modifiers & modifier.bit) != 0 && !is_itself)
            names += fmt::format("{}{}", names.empty() ? "" : "+", modifier.name);
    }
    return names;
}

} // namespace overt
