/// The best context that needs no window.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/gl/gl_context.h"

namespace overt {

/// One attempt to make a context, for the messages.
struct ContextAttempt {
    ContextKind kind;
    std::string outcome; ///< "works: …" or why it does not
};

/// What a context that works is told by: version, renderer, and how it was reached.
std::string summary_of(const GlDescription& description);

/// Makes a context that needs no window. With a kind, that one or a GraphicsError that says why not and what
/// was tried; without, EGL where a graphics processor is behind it, else OSMesa.
std::unique_ptr<GlContext> make_headless_context(std::optional<ContextKind> kind);

/// Tries OSMesa and each device of EGL. Never throws; a context that was made is destroyed again.
std::vector<ContextAttempt> survey_headless_contexts();

} // namespace overt
