#include "render/gl/headless_context.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "render/gl/egl_context.h"
#include "render/gl/osmesa_context.h"

namespace overt {

namespace {

/// Makes a context of one kind and notes how it went; null if it did not work.
template <class Context>
std::unique_ptr<GlContext> attempt(ContextKind kind, std::vector<ContextAttempt>& attempts) {
    try {
        std::unique_ptr<GlContext> context = std::make_unique<Context>();
        attempts.push_back({kind, summary_of(context->description())});
        return context;
    } catch (const GraphicsError& error) {
        attempts.push_back({kind, fmt::format("refused: {}", error.what())});
        return nullptr;
    }
}

std::string listed(const std::vector<ContextAttempt>& attempts) {
    std::string lines;
    for (const ContextAttempt& tried : attempts)
        lines += fmt::format("\n  {}: {}", name_of(tried.kind), tried.outcome);
    return lines;
}

} // namespace

std::string summary_of(const GlDescription& description) {
    return fmt::format("{} ({}; {})", description.version, description.renderer, description.platform);
}

std::unique_ptr<GlContext> make_headless_context(std::optional<ContextKind> kind) {
    std::vector<ContextAttempt> tried;
    std::unique_ptr<GlContext> context;
    if (kind == ContextKind::egl) {
        context = attempt<EglContext>(ContextKind::egl, tried);
    } else if (kind == ContextKind::osmesa) {
        context = attempt<OsMesaContext>(ContextKind::osmesa, tried);
    } else {
        OVERT_EXPECTS(!kind);
        context = attempt<EglContext>(ContextKind::egl, tried);
        // Software EGL has nothing over OSMesa, which needs no display stack at all.
        if (context && context->description().is_software) {
            if (auto osmesa = attempt<OsMesaContext>(ContextKind::osmesa, tried))
                context = std::move(osmesa);
        } else if (!context) {
            context = attempt<OsMesaContext>(ContextKind::osmesa, tried);
        }
    }
    if (!context) {
        throw GraphicsError(
            fmt::format("no OpenGL context can be made. Tried:{}\nRemedy: install libosmesa6 and "
                        "libgl1-mesa-dri, or choose another with --context",
                        listed(tried)));
    }
    context->make_current();
    return context;
}

std::vector<ContextAttempt> survey_headless_contexts() {
    std::vector<ContextAttempt> found;
    attempt<OsMesaContext>(ContextKind::osmesa, found);
    for (const std::string& outcome : EglContext::survey())
        found.push_back({ContextKind::egl, outcome});
    return found;
}

} // namespace overt
