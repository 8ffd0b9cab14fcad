/// A context without a surface, on a graphics processor where there is one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/gl/gl_context.h"

namespace overt {

class EglContext final : public GlContext {
  public:
    /// Takes the first EGL device with a graphics processor behind it, else the first that works, else Mesa's
    /// surfaceless platform. Throws GraphicsError that names all that was tried.
    EglContext();
    ~EglContext() override;
    void make_current() override;

    /// One line for each device and for the surfaceless platform: what it offers or why it refuses.
    static std::vector<std::string> survey();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace overt
