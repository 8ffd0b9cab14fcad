#include "render/gl/osmesa_context.h"

#include <array>

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// The functions of OSMesa that a context needs.
struct OsMesaLibrary {
    decltype(&OSMesaCreateContextAttribs) create_context;
    decltype(&OSMesaDestroyContext) destroy_context;
    decltype(&OSMesaMakeCurrent) make_current;
    decltype(&OSMesaGetProcAddress) function_of;
};

template <class Function> Function function_in(void* library, const char* name) {
    void* const address = dlsym(library, name);
    if (!address)
        throw GraphicsError(fmt::format("OSMesa lacks the function {}", name));
    return reinterpret_cast<Function>(address);
}

/// OSMesa brings a compiler with it, whose loading takes as long as all else that most commands do. So it is
/// loaded by the first context that is drawn with it, and stays: contexts of several threads share it.
const OsMesaLibrary& osmesa() {
    static const OsMesaLibrary library = [] {
        // The one interface that it has had since Mesa 8.
        constexpr const char* name = "libOSMesa.so.8";
        void* const handle = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
        if (!handle)
            throw GraphicsError(
                fmt::format("OSMesa cannot be loaded: {}. Install the package libosmesa6.", dlerror()));
        return OsMesaLibrary{
            function_in<decltype(OsMesaLibrary::create_context)>(handle, "OSMesaCreateContextAttribs"),
            function_in<decltype(OsMesaLibrary::destroy_context)>(handle, "OSMesaDestroyContext"),
            function_in<decltype(OsMesaLibrary::make_current)>(handle, "OSMesaMakeCurrent"),
            function_in<decltype(OsMesaLibrary::function_of)>(handle, "OSMesaGetProcAddress")};
    }();
    return library;
}

} // namespace

struct OsMesaContext::State {
    OSMesaContext context = nullptr;
    // OSMesa insists on a colour buffer of its own; everything is drawn into framebuffer objects, so one
    // pixel will do.
    std::array<unsigned char, 4> pixel{};
    ~State() {
        if (context)
            osmesa().destroy_context(context);
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
        state_->context = osmesa().create_context(attributes, nullptr);
        if (state_->context)
            break;
    }
    if (!state_->context)
        throw GraphicsError("OSMesa gives no core context of OpenGL 3.3 or later");
    make_current();
    load_functions(reinterpret_cast<GLADloadfunc>(osmesa().function_of), ContextKind::osmesa, "OSMesa");
}

OsMesaContext::~OsMesaContext() = default;

void OsMesaContext::make_current() {
    if (!osmesa().make_current(state_->context, state_->pixel.data(), GL_UNSIGNED_BYTE, 1, 1)) {
        throw GraphicsError("the OSMesa context cannot be made current");
    }
}

} // namespace overt
