#include "render/gl/gl_context.h"
#include "render/gl/headless_context.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "render/gl/gl_objects.h"
#include "tests/support/gl_contexts.h"

using namespace overt;

TEST_CASE("each headless context is OpenGL 3.3 core or later and says what it is", "[gl]") {
    for (const ContextKind kind : test::headless_kinds) {
        const auto context = make_headless_context(kind);
        CHECK(context->description().kind == kind);
        CHECK_FALSE(context->description().renderer.empty());
        GLint major = 0, minor = 0, profile = 0;
        context->gl().GetIntegerv(GL_MAJOR_VERSION, &major);
        context->gl().GetIntegerv(GL_MINOR_VERSION, &minor);
        context->gl().GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
        CHECK(10 * major + minor >= 33);
        CHECK((profile & GL_CONTEXT_CORE_PROFILE_BIT) != 0);
    }
}

TEST_CASE("two contexts live side by side, each with its own functions and objects", "[gl]") {
    const auto first = make_headless_context(ContextKind::osmesa);
    first->make_current();
    const Framebuffer target(*first, {2, 2}, PixelFormat::rgba8);
    const auto second = make_headless_context(ContextKind::osmesa);
    first->make_current();
    target.bind();
    const GLfloat colour[] = {1, 0, 0, 1};
    first->gl().ClearBufferfv(GL_COLOR, 0, colour);
    std::vector<std::byte> pixels(16);
    target.read(PixelFormat::rgba8, pixels);
    CHECK(pixels[0] == std::byte{255});
    CHECK(pixels[1] == std::byte{0});
}

TEST_CASE("a texture that is too large is refused by name and size", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    CHECK_THROWS_WITH((Texture2D(*context, {1 << 20, 1}, PixelFormat::rgba32f)),
                      Catch::Contains("1048576 x 1 RGBA32F"));
}
