#include "render/window/server_gamma.h"

#include <array>
#include <cstdint>

#include <sys/uio.h>
#include <xcb/xcbext.h>

#include "render/window/xcb_reply.h"

namespace overt {
namespace {

// xf86vidmode has no header of xcb's in Debian; the request and its answer are those of xf86vmproto.h.
constexpr std::uint8_t get_gamma = 16;
constexpr double unit = 10'000.0; // of a gamma in the answer

struct GammaQuestion {
    std::uint8_t major, minor; // both and the length are filled in by xcb
    std::uint16_t length;
    std::uint16_t screen, unused;
    std::uint32_t unused_too[6];
};
static_assert(sizeof(GammaQuestion) == 32);

struct GammaAnswer {
    std::uint8_t type, unused;
    std::uint16_t sequence;
    std::uint32_t length;
    std::uint32_t red, green, blue;
    std::uint32_t unused_too[3];
};
static_assert(sizeof(GammaAnswer) == 32);

xcb_extension_t video_mode = {"XFree86-VidModeExtension", 0};

} // namespace

ServerGamma server_gamma(xcb_connection_t* link, int screen) {
    const xcb_query_extension_reply_t* const offered = xcb_get_extension_data(link, &video_mode);
    if (!offered || !offered->present)
        return {};
    GammaQuestion question{};
    question.screen = static_cast<std::uint16_t>(screen);
    // xcb puts what it needs before the first part that it is given.
    std::array<iovec, 3> parts{};
    parts[2] = {&question, sizeof question};
    const xcb_protocol_request_t request{1, &video_mode, get_gamma, 0};
    const unsigned sequence = xcb_send_request(link, XCB_REQUEST_CHECKED, parts.data() + 2, &request);
    xcb_generic_error_t* refused = nullptr;
    const auto answer = owned(static_cast<GammaAnswer*>(xcb_wait_for_reply(link, sequence, &refused)));
    const auto freed = owned(refused);
    if (!answer)
        return {};
    return {answer->red / unit, answer->green / unit, answer->blue / unit};
}

ServerGamma server_gamma() {
    int screen = 0;
    const XcbLink link{xcb_connect(nullptr, &screen), &xcb_disconnect};
    return xcb_connection_has_error(link.get()) == 0 ? server_gamma(link.get(), screen) : ServerGamma{};
}

} // namespace overt
