#include "render/gl/osmesa_context.h"

#include <array>

#include <GL/osmesa.h>

#include "experiment/base/error.h"

namespace overt {

struct OsMesaContext::State {
    OSMesaContext context = nullptr;
    // OSMesa insists on a colour buffer of its own; everything is drawn into framebuffer objects, so one
    // pixel will do.
    std::array<unsigned char, 4> pixel{};
    ~State() {
        if (context)
            OSMesaDestroyContext(context);
    }
};

OsMesaContext::OsMesaContext() : state_(std::make_unique<State>()) {
    // 4.5 first: Mesa's OSMesa knows no 4.6, and older ones stop at 3.3.
    for (const auto& [major, minor] : {std::pair{4, 5}, std::pair{3, 3}}) {
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_DEPTH_BITS,
                                  0,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  major,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  minor,
                                  0};
        state_->context = OSMesaCreateContextAttribs(attributes, nullptr);
        if (state_->context)
            break;
    }
    if (!state_->context)
        throw GraphicsError("OSMesa gives no core context of OpenGL 3.3 or later");
    make_current();
    load_functions(reinterpret_cast<GLADloadfunc>(OSMesaGetProcAddress), ContextKind::osmesa, "OSMesa");
}

OsMesaContext::~OsMesaContext() = default;

void OsMesaContext::make_current() {
    if (!OSMesaMakeCurrent(state_->context, state_->pixel.data(), GL_UNSIGNED_BYTE, 1, 1)) {
        throw GraphicsError("the OSMesa context cannot be made current");
    }
}

} // namespace overt
