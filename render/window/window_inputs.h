/// What keyboard and mouse did in a window, until somebody asks for it.
#pragma once

#include <array>
#include <cstddef>

#include <glm/glm.hpp>

#include "experiment/ports/observer_input.h"

namespace overt {

/// Keys that a window reports are told by GLFW's numbers: what is written on them is asked for later.
struct WindowInput {
    ObserverInput::Kind kind = ObserverInput::Kind::key_down;
    int code = 0, glfw_key = -1;  ///< of a key: the system's scancode, and GLFW's number
    char32_t character = 0;       ///< of a text
    bool is_repeated = false;     ///< of a text: written by a key that is held
    glm::dvec2 from_middle_px{0}; ///< of the pointer, in pixels of the framebuffer, right and down
    int button = 0;               ///< 1 left, 2 middle, 3 right, then as GLFW numbers them
    double steps = 0.0;           ///< of the wheel
};

/// Where the pointer is, from the middle of the framebuffer: the desktop's own units may be larger than a
/// pixel. Half a pixel more, since X tells the number of the pixel that the pointer is in.
inline glm::dvec2 pointer_from_middle_px(glm::dvec2 pointer, glm::ivec2 window_size,
                                         glm::ivec2 framebuffer_px) {
    const glm::dvec2 scale = glm::dvec2(framebuffer_px) / glm::dvec2(glm::max(window_size, glm::ivec2(1)));
    return pointer * scale + 0.5 - 0.5 * glm::dvec2(framebuffer_px);
}

/// A ring, so that nothing is allocated in a presentation. Of movements that follow each other the last one
/// is kept: they are all told with one time anyway. What is not asked for gives way to what comes later.
class WindowInputs {
  public:
    void push(const WindowInput& input) noexcept {
        using Kind = ObserverInput::Kind;
        if (count_ > 0 && input.kind == Kind::pointer_moved && last().kind == Kind::pointer_moved) {
            last() = input;
            return;
        }
        if (count_ == inputs_.size()) {
            first_ = (first_ + 1) % inputs_.size();
            --count_;
        }
        ++count_;
        last() = input;
    }

    /// The oldest one, if there is any.
    bool next(WindowInput& input) noexcept {
        if (count_ == 0)
            return false;
        input = inputs_[first_];
        first_ = (first_ + 1) % inputs_.size();
        --count_;
        return true;
    }

  private:
    WindowInput& last() noexcept { return inputs_[(first_ + count_ - 1) % inputs_.size()]; }

    std::array<WindowInput, 256> inputs_{};
    std::size_t first_ = 0, count_ = 0;
};

} // namespace overt
