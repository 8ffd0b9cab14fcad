/// The window of the operator's view, on a screen of its own, with the mouse on its buttons.
#include <catch2/catch.hpp>

#include <functional>
#include <thread>

#include "devices/operator/operator_server.h"
#include "tests/support/running_program.h"
#include "tests/support/seen_screen.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/virtual_screen.h"
// Defines words, so comes last.
#include "tests/support/keyboard.h"

using namespace overt;
using namespace overt::test;

namespace {

using namespace std::chrono_literals;

/// Whether it comes true; a busy machine has half a minute.
bool comes_true(const std::function<bool()>& is_true) {
    for (int tries = 0; tries < 600; ++tries) {
        if (is_true())
            return true;
        std::this_thread::sleep_for(50ms);
    }
    return false;
}

/// The middle of what is drawn in the colour of the right eye's gaze, in the part of the window for the
/// stimulus.
std::optional<std::pair<double, double>> seen_gaze(const SeenScreen& screen) {
    double x_sum = 0.0, y_sum = 0.0;
    int count = 0;
    for (int y = 0; y < 660; ++y)
        for (int x = 0; x < 640; ++x) {
            const auto [red, green, blue] = screen.at(x, y);
            if (red > 200 && green > 120 && green < 200 && blue < 90) {
                x_sum += x;
                y_sum += y;
                ++count;
            }
        }
    if (count < 10)
        return std::nullopt;
    return std::pair{x_sum / count, y_sum / count};
}

/// A mouse on the only window of a screen.
class Mouse {
  public:
    explicit Mouse(Display* display) : display_(display) {
        XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
    }
    /// Whether there is a window by now.
    bool finds_window() {
        Window root = 0, parent = 0, *children = nullptr;
        unsigned count = 0;
        XQueryTree(display_, XDefaultRootWindow(display_), &root, &parent, &children, &count);
        for (unsigned i = 0; i < count; ++i) {
            XWindowAttributes facts{};
            if (XGetWindowAttributes(display_, children[i], &facts) != 0 && facts.width == 1280 &&
                facts.map_state == IsViewable)
                window_ = children[i];
        }
        if (children)
            XFree(children);
        return window_ != 0;
    }
    void click(int x, int y) {
        XSetInputFocus(display_, window_, RevertToParent, CurrentTime);
        XWarpPointer(display_, 0, window_, 0, 0, 0, 0, x, y);
        XSync(display_, False);
        // The window looks at the mouse thirty times a second.
        std::this_thread::sleep_for(300ms);
        for (const int kind : {ButtonPress, ButtonRelease}) {
            XButtonEvent event{};
            event.type = kind;
            event.display = display_;
            event.window = window_;
            event.root = XDefaultRootWindow(display_);
            event.same_screen = True;
            event.x = x;
            event.y = y;
            event.button = Button1;
            XSendEvent(display_, window_, True, kind == ButtonPress ? ButtonPressMask : ButtonReleaseMask,
                       reinterpret_cast<XEvent*>(&event));
            XSync(display_, False);
            std::this_thread::sleep_for(200ms);
        }
    }

  private:
    Display* display_;
    Window window_ = 0;
};

} // namespace

TEST_CASE("the window shows gaze where it is, sends a pause at once and asks before it skips", "[session]") {
    const TemporaryFolder folder;
    const auto screen = VirtualScreen::start(1280, 800, 24, folder.path().string());
    OperatorServer::Options options;
    options.socket = folder.path() / "view.sock";
    options.facts.trials = 10;
    options.facts.has_tracker = true;
    options.facts.width_px = 1000;
    options.facts.height_px = 500;
    ViewedStimulus bust;
    bust.object = "bust";
    options.facts.slots = {{"centre", 250, 0, 500, 500}};
    options.trials = {{"task", "What?", {bust}}};
    OperatorServer server(std::move(options));
    RunningProgram program({"watch", "--operator-socket", (folder.path() / "view.sock").string()},
                           x_server_alone, folder.path() / "said");
    Display* const display = XOpenDisplay(nullptr);
    REQUIRE(display);
    Mouse mouse(display);
    REQUIRE(comes_true([&] { return mouse.finds_window(); }));

    const auto push = [&](ViewNews::Kind kind) {
        ViewNews news;
        news.kind = kind;
        news.trial = 0;
        news.phase = SessionPhase::stimulus;
        news.pose = 0;
        server.push(news);
    };
    push(ViewNews::Kind::phase);
    push(ViewNews::Kind::trial_started);
    push(ViewNews::Kind::flip);
    const SeenScreen seen(folder.path());
    using Place = std::optional<std::pair<double, double>>;
    const auto gaze_at = [&](double x, double y, const Place& earlier) {
        Place at;
        // Until all points that are kept are there, and those of the place before are gone.
        comes_true([&] {
            for (int i = 0; i < 60; ++i)
                server.push_gaze({{}, {}, true, true, {x, y}});
            const auto before = at;
            at = seen_gaze(seen);
            return at && before && at == before && at != earlier;
        });
        REQUIRE(at);
        return *at;
    };
    const auto left = gaze_at(250.0, 125.0, {});
    const auto right = gaze_at(750.0, 375.0, left);
    // The display is drawn with its own proportions, so both distances are half of its sides.
    CHECK(right.first - left.first == Approx(2.0 * (right.second - left.second)).margin(3.0));
    CHECK(right.first - left.first > 200.0);

    OperatorCommand command;
    // A busy machine may miss a click, so it is made until it has its effect.
    REQUIRE(comes_true([&] {
        mouse.click(40, 685);
        return server.next_command(command);
    }));
    CHECK(words_of(command) == "pause");
    while (server.next_command(command)) {
    }
    mouse.click(403, 685);
    std::this_thread::sleep_for(500ms);
    CHECK(!server.next_command(command));
    REQUIRE(comes_true([&] {
        mouse.click(640, 408);
        if (server.next_command(command))
            return true;
        mouse.click(403, 685);
        return false;
    }));
    CHECK(words_of(command) == "skip");
    XCloseDisplay(display);
    CHECK(program.is_running());
}
