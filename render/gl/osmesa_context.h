/// A context drawn by the processor into memory, with no display stack: tests and headless sessions.
#pragma once

#include <memory>

#include "render/gl/gl_context.h"

namespace overt {

class OsMesaContext final : public GlContext {
  public:
    /// Loads OSMesa, unless an earlier context has. Throws GraphicsError if it is not there, or offers no core
    /// profile of 3.3 or later.
    OsMesaContext();
    ~OsMesaContext() override;
    void make_current() override;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace overt
