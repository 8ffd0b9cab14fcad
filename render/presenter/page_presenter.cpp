#include "render/presenter/page_presenter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "render/presenter/noise_picture.h"
#include "render/presenter/screen_text.h"
#include "render/presenter/setup_screens.h"

namespace overt {

namespace {

/// Long enough for a recorder that samples at 1 kHz.
constexpr double onset_pulse_ms = 5.0;

/// Copies pixel by pixel.
void blit(const GladGLContext& gl, const Framebuffer& from, const Framebuffer& to, glm::ivec2 from_px,
          glm::ivec2 to_px, glm::ivec2 size_px) noexcept {
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.name());
    gl.BlitFramebuffer(from_px.x, from_px.y, from_px.x + size_px.x, from_px.y + size_px.y, to_px.x, to_px.y,
                       to_px.x + size_px.x, to_px.y + size_px.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

DisplaySettings of_size(DisplaySettings display, glm::ivec2 screen_px) {
    display.width_px = screen_px.x;
    display.height_px = screen_px.y;
    return display;
}

bool has_colour_table(OutputMode mode) { return row_of(mode).shows == ShownLight::greys_by_table; }

} // namespace

PagePresenter::PagePresenter(const GlContext& context, DisplaySurface& surface, const FrameSource& frames,
                             const ScreenGeometry& geometry, const DisplaySettings& display,
                             ScreenSettings screens, std::vector<ImageBox> slots, Eye eye)
    : context_(&context), surface_(&surface), geometry_(geometry),
      display_(of_size(display, geometry.screen_px)), screens_(std::move(screens)), encoder_(display_),
      background_(context, geometry.screen_px, encoder_.format()),
      picture_(context, geometry.screen_px, encoder_.format()),
      store_(context, frames, encoder_, slots.empty() ? std::vector{geometry.image_box()} : slots,
             static_cast<std::size_t>(display.frame_store_mb * 1e6), eye),
      page_target_(context), slots_(std::move(slots)) {
    if (slots_.empty())
        slots_.push_back(geometry.image_box());
    check_depth();
    // Where a driver dithers at all, it must not when bytes are to arrive as they are.
    context.gl().Disable(GL_DITHER);
    std::vector<std::byte> bytes(bytes_in(geometry.screen_px, encoder_.format()));
    encoder_.encode_background(geometry.screen_px, bytes);
    if (has_psync(display.output)) {
        // PSYNC stands on black.
        const std::array<std::byte, 4> black{{{}, {}, {}, std::byte{255}}};
        for (std::size_t i = 0; i < 4 * static_cast<std::size_t>(geometry.screen_px.x); ++i)
            bytes[i] = black[i % 4];
    }
    background_.texture().upload(bytes);
    put_tags();
    if (encoder_.leaves_last_step()) {
        last_step_.emplace(context, display_);
        signal_.emplace(context, geometry.screen_px, last_step_->format());
    }
    if (has_colour_table(display.output))
        colour_table_row_ = t_lock::row_of(encoder_.colour_table());
    onset_packet_ = t_lock::pulse(static_cast<std::uint16_t>(display.onset_trigger), 0.0, onset_pulse_ms);
    make_patch();
    clear_picture();
}

std::string PagePresenter::why_closed() const {
    return is_interrupted()    ? std::string(interrupted_reason)
           : !failure_.empty() ? "a frame could not be shown: " + failure_
                               : surface_->why_closed();
}

void PagePresenter::check_depth() const {
    const int has = surface_->bits_per_channel();
    const int needs = row_of(display_.output).framebuffer_bits;
    if (has != needs) {
        throw GraphicsError(
            fmt::format("{} sends {} bits per channel, but the framebuffer of {} has {}: {}",
                        name_of(display_.output), needs, context_->description().platform, has,
                        needs == 10 ? "set the screen to a depth of 30 bits, or take another output"
                                    : "set the screen to a depth of 24 bits"));
    }
    const glm::ivec2 screen = geometry_.screen_px;
    if (joins_pixels_in_pairs(display_.output) && screen.x % 2 != 0) {
        throw GraphicsError(fmt::format("{} joins pixels in pairs, which a screen of {} columns cannot hold",
                                        name_of(display_.output), screen.x));
    }
    if (has_t_lock(display_.output) && screen.x < static_cast<int>(colour_table_row_.size())) {
        throw GraphicsError(fmt::format("{} sends messages in rows of {} pixels, the screen has only {}",
                                        name_of(display_.output), colour_table_row_.size(), screen.x));
    }
    for (std::size_t slot = 0; slot < slots_.size(); ++slot)
        check_place(slot);
}

void PagePresenter::check_place(std::size_t slot) const {
    const ImageBox& at = slots_[slot];
    const glm::ivec2 screen = geometry_.screen_px, first = at.origin_px, end = first + at.size_px;
    // A page is encoded once for all slots of its size: pixels must be joined in pairs alike in each, and
    // filters reach alike beside it.
    const auto alike =
        static_cast<std::size_t>(std::ranges::find(slots_, at.size_px, &ImageBox::size_px) - slots_.begin());
    const ScreenPatch &patch = store_.patch(static_cast<int>(slot)),
                      &pages = store_.patch(static_cast<int>(alike));
    OVERT_EXPECTS(patch.size_px == pages.size_px &&
                  patch.origin_px - at.origin_px == pages.origin_px - slots_[alike].origin_px);
    if (first.x < 0 || first.y < reserved_rows(display_.output) || end.x > screen.x || end.y > screen.y) {
        throw GraphicsError(
            fmt::format("a stimulus in columns {} to {} and rows {} to {} leaves the screen of {} x {}, or "
                        "covers the {} rows at its top that {} reserves",
                        first.x, end.x - 1, first.y, end.y - 1, screen.x, screen.y,
                        reserved_rows(display_.output), name_of(display_.output)));
    }
}

void PagePresenter::load_slots(std::span<const PlacedStimulus> shown) {
    if (loaded_ && std::ranges::equal(shown_, shown)) {
        store_.rewind();
        return;
    }
    loaded_ = nullptr;
    const StoredStimuli& stored = store_.load(shown);
    in_slots_.clear();
    for (const PlacedStimulus& placed : shown)
        in_slots_.push_back({store_.picture_of(stored, placed), store_.patch(placed.slot)});
    shown_.assign(shown.begin(), shown.end());
    loaded_ = &stored;
    clear_picture();
}

void PagePresenter::expect_slots(std::span<const PlacedStimulus> shown) noexcept { store_.expect(shown); }

void PagePresenter::clear_picture(bool for_stimulus) noexcept {
    blit(context_->gl(), for_stimulus ? around_stimuli() : background_, picture_, {0, 0}, {0, 0},
         geometry_.screen_px);
    is_stimulus_on_canvas_ = false;
    for (InSlot& slot : in_slots_)
        slot.page_on_canvas = -1;
}

bool PagePresenter::attach_page(int page) noexcept {
    try {
        page_target_.attach_layer(*loaded_->textures, store_.layer_of(page));
        return true;
    } catch (const std::exception& error) {
        if (failure_.empty())
            failure_ = error.what();
        return false;
    }
}

void PagePresenter::put_page(InSlot& slot, int page) noexcept {
    if (!is_stimulus_on_canvas_)
        clear_picture(true);
    is_stimulus_on_canvas_ = true;
    // A frame is held for several refreshes: what is there need not be drawn again, nor are marks on it.
    const bool are_marks_there = page < 0 || !are_marks_new_ || (!slot.has_marks && mark_count_ == 0);
    if (page == slot.page_on_canvas && are_marks_there)
        return;
    const auto& [origin_px, size_px] = slot.patch;
    if (page < 0) {
        blit(context_->gl(), around_stimuli(), picture_, origin_px, origin_px, size_px);
    } else if (!attach_page(page)) {
        return;
    } else {
        blit(context_->gl(), page_target_, picture_, {0, 0}, origin_px, size_px);
    }
    slot.page_on_canvas = page;
    slot.has_marks = false;
    if (page < 0)
        return;
    slot.last_page = page;
    slot.last_lit = ++pages_put_;
    put_marks(slot);
}

void PagePresenter::put_marks(InSlot& slot) noexcept {
    for (std::size_t i = 0; mark_pass_ && i < mark_count_; ++i) {
        mark_pass_->draw(marks_[i], picture_, slot.patch);
        slot.has_marks = true;
    }
}

void PagePresenter::mark_stimuli(std::span<const StimulusMark> marks,
                                 std::span<const StimulusMark> /*of_other_eye*/) noexcept {
    try {
        if (!mark_pass_ && !marks.empty())
            mark_pass_.emplace(*context_, display_);
        for (const StimulusMark& mark : marks)
            mark_pass_->prepare(mark.light);
    } catch (const std::exception&) {
        marks = {}; // no memory for a light
    }
    const std::size_t count = std::min(marks.size(), marks_.size());
    are_marks_new_ =
        are_marks_new_ || count != mark_count_ ||
        !std::equal(marks_.begin(), marks_.begin() + static_cast<std::ptrdiff_t>(count), marks.begin());
    std::copy_n(marks.begin(), count, marks_.begin());
    mark_count_ = count;
}

bool PagePresenter::comes_up(std::size_t index) const noexcept {
    if (!is_stimulus_on_canvas_)
        return true;
    for (std::size_t i = 0; i < in_slots_.size(); ++i)
        if (shown_[i].slot == shown_[index].slot && in_slots_[i].page_on_canvas >= 0)
            return false;
    return true;
}

const PagePresenter::InSlot& PagePresenter::lit_last_with(std::size_t index) const {
    std::size_t last = index;
    for (std::size_t i = 0; i < in_slots_.size(); ++i)
        if (shown_[i].slot == shown_[index].slot && in_slots_[i].last_lit > in_slots_[last].last_lit)
            last = i;
    return in_slots_[last];
}

void PagePresenter::put_masks(const Screen& screen) {
    for (const int place : screen.places.empty() ? std::vector{0} : screen.places) {
        const auto index = static_cast<std::size_t>(place);
        const bool is_loaded = index < shown_.size();
        ScreenGeometry at = geometry_;
        if (is_loaded) {
            const ImageBox& slot = slots_.at(static_cast<std::size_t>(shown_[index].slot));
            at.image_origin_px = slot.origin_px;
            at.image_px = slot.size_px;
        }
        if (screen.kind == Screen::Kind::noise)
            put_on(picture_, draw_noise(screen, at, place).picture, at.image_origin_px);
        else if (is_loaded && loaded_)
            put_scrambled(lit_last_with(index), at.image_box(), screen, place);
    }
}

/// On the card, so that it takes no longer than a screen: encoded pages, in squares of even columns, since
/// some outputs join pixels in pairs. What is left at the edges stays empty.
void PagePresenter::put_scrambled(const InSlot& slot, const ImageBox& at, const Screen& screen, int place) {
    const double wished_px = screen.noise_cell.value * geometry_.px_per_deg_at_centre();
    const int side = std::max(2, 2 * static_cast<int>(std::lround(0.5 * wished_px)));
    const glm::ivec2 squares = at.size_px / side;
    const glm::ivec2 first = (at.size_px - squares * side) / 4 * 2;
    std::vector<int> order(static_cast<std::size_t>(squares.x * squares.y));
    std::iota(order.begin(), order.end(), 0);
    RandomStream(screen.noise_seed, "mask squares", static_cast<std::uint64_t>(place))
        .shuffle(std::span(order));
    const int page = slot.last_page >= 0 ? slot.last_page : loaded_->page_of(slot.picture, 0);
    if (!attach_page(page))
        return;
    const auto corner = [&](int square) {
        return first + side * glm::ivec2(square % squares.x, square / squares.x);
    };
    for (std::size_t i = 0; i < order.size(); ++i)
        blit(context_->gl(), page_target_, picture_, corner(order[i]) + at.origin_px - slot.patch.origin_px,
             corner(static_cast<int>(i)) + at.origin_px, {side, side});
}

void PagePresenter::make_patch() {
    const std::optional<PatchPlace> place = photodiode_patch_of(display_);
    if (!place)
        return;
    const auto square = [&](float light) {
        LinearImage picture(place->size_px);
        std::ranges::fill(picture.pixels, glm::vec4(light, light, light, 1.0f));
        return encoded(picture, place->origin_px);
    };
    const ScreenPatch around = encoder_.patch_of(place->origin_px, place->size_px);
    patch_.emplace(Patch{{around.origin_px, around.size_px}, square(0.0f), square(1.0f)});
}

void PagePresenter::put_patch(bool white) noexcept {
    if (patch_)
        blit(context_->gl(), white ? patch_->white : patch_->black, picture_, {0, 0}, patch_->place.origin_px,
             patch_->place.size_px);
}

/// They stand on the background, and so on every screen and beside every frame.
void PagePresenter::put_tags() {
    for (const TagPlace& tag : gaze_tags_of(geometry_, display_, slots_)) {
        LinearImage picture(tag.size_px);
        const int module_px = tag.size_px.x / tag_modules;
        for (int y = 0; y < tag.size_px.y; ++y) {
            for (int x = 0; x < tag.size_px.x; ++x) {
                const float light = is_white_module(tag.id, x / module_px, y / module_px)
                                        ? static_cast<float>(display_.tags_light)
                                        : 0.0f;
                picture.at(x, y) = glm::vec4(light, light, light, 1.0f);
            }
        }
        put_on(background_, picture, tag.origin_px);
    }
}

Framebuffer PagePresenter::encoded(const LinearImage& picture, glm::ivec2 origin) const {
    Framebuffer made(*context_, encoder_.patch_of(origin, picture.size_px).size_px, encoder_.format());
    std::vector<std::byte> bytes(bytes_in(made.size_px(), encoder_.format()));
    encoder_.encode(picture, origin, bytes);
    made.texture().upload(bytes);
    return made;
}

void PagePresenter::put_on(const Framebuffer& target, const LinearImage& picture, glm::ivec2 origin) {
    const ScreenPatch patch = encoder_.patch_of(origin, picture.size_px);
    blit(context_->gl(), encoded(picture, origin), target, {0, 0}, patch.origin_px, patch.size_px);
}

FlipReport PagePresenter::show(const Screen& screen) {
    clear_picture();
    PlacedPicture placed;
    if (screen.kind == Screen::Kind::noise || screen.kind == Screen::Kind::scrambled)
        put_masks(screen);
    else if (screen.kind != Screen::Kind::blank)
        placed = draw_screen(screen, geometry_, screens_, display_.background, answer_pictures_);
    targets_ = std::move(placed.targets);
    surface_->show_pointer(screen.kind == Screen::Kind::answers && screen.answers.shows_pointer);
    if (!placed.picture.pixels.empty()) {
        // It stands on the background already.
        for (glm::vec4& pixel : placed.picture.pixels)
            pixel.w = 1.0f;
        put_on(picture_, placed.picture, placed.origin_px);
    }
    put_patch(false);
    throw_on_gl_error(*context_, "drawing a screen");
    return present();
}

void PagePresenter::put_beside_stimuli(const AnswerView* answers) {
    beside_ = {};
    is_stimulus_on_canvas_ = false; // what stands there is drawn anew with the next flip
    if (!answers)
        return;
    beside_.shows_pointer = answers->shows_pointer;
    if (answers->items.empty() && answers->accept.empty())
        return;
    Screen screen{.kind = Screen::Kind::answers, .text = ""};
    screen.answers = *answers;
    PlacedPicture placed = draw_screen(screen, geometry_, screens_, display_.background, answer_pictures_);
    beside_.targets = std::move(placed.targets);
    for (glm::vec4& pixel : placed.picture.pixels)
        pixel.w = 1.0f;
    beside_.picture.emplace(*context_, geometry_.screen_px, encoder_.format());
    blit(context_->gl(), background_, *beside_.picture, {0, 0}, {0, 0}, geometry_.screen_px);
    if (!placed.picture.pixels.empty())
        put_on(*beside_.picture, placed.picture, placed.origin_px);
    throw_on_gl_error(*context_, "drawing answers beside a stimulus");
}

void PagePresenter::show_level(const LevelBar& bar) {
    LinearImage picture = draw_level_bar(bar, geometry_, screens_, display_.background);
    put_on(picture_, picture, level_bar_origin(geometry_, picture.size_px));
    put_patch(false);
    throw_on_gl_error(*context_, "drawing a level meter");
    present();
}

FlipReport PagePresenter::flip_slots(std::span<const AnimationFrameIndex> frames) noexcept {
    OVERT_EXPECTS(loaded_ && frames.size() == in_slots_.size());
    // An onset is when something comes up in a slot that was empty.
    bool is_onset = false;
    for (std::size_t i = 0; i < frames.size(); ++i)
        is_onset = is_onset || (frames[i].value >= 0 && comes_up(i));
    if (!is_stimulus_on_canvas_)
        surface_->show_pointer(beside_.shows_pointer);
    if (is_onset && display_.onset_trigger != 0) {
        if (has_t_lock(display_.output))
            send_with_next_flip(t_lock::outputs_row, onset_packet_);
        else
            outputs_ = display_.onset_trigger;
    }
    bool is_new_frame = is_onset;
    // What goes is taken away first: what comes may lie in the same place.
    for (std::size_t i = 0; i < frames.size(); ++i)
        if (frames[i].value < 0)
            put_page(in_slots_[i], -1);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        InSlot& slot = in_slots_[i];
        const int frame = frames[i].value;
        OVERT_EXPECTS(frame < static_cast<int>(loaded_->page_of_frame[slot.picture].size()));
        if (frame >= 0)
            put_page(slot, loaded_->page_of(slot.picture, frame));
        is_new_frame = is_new_frame || frame != slot.frame_on_canvas;
        slot.frame_on_canvas = frame;
    }
    are_marks_new_ = false;
    if (is_new_frame) {
        patch_is_white_ = is_onset || !patch_is_white_;
        put_patch(patch_is_white_);
    }
    return present();
}

FlipReport PagePresenter::present() noexcept {
    compose();
    put_messages();
    ++refreshes_;
    const FlipReport report = surface_->present(veil_ ? *veil_ : canvas());
    store_.stream_on();
    return report;
}

void PagePresenter::veil(bool is_on) {
    veil_.reset();
    if (!is_on)
        return;
    const PixelFormat format = last_step_ ? last_step_->format() : encoder_.format();
    veil_.emplace(*context_, geometry_.screen_px, format);
    veil_->texture().upload(std::vector<std::byte>(bytes_in(geometry_.screen_px, format)));
}

void PagePresenter::compose() noexcept {
    if (last_step_)
        last_step_->draw(picture_.texture(), *signal_, refreshes_);
}

void PagePresenter::send_with_next_flip(int row, const t_lock::Packet& packet) noexcept {
    OVERT_EXPECTS(has_t_lock(display_.output) && row >= 0 && row < reserved_rows(display_.output));
    for (std::optional<Message>& message : messages_) {
        if (!message || message->row == row) {
            message = {row, t_lock::row_of(packet)};
            return;
        }
    }
    OVERT_EXPECTS(false);
}

void PagePresenter::put_row(int row, int first_px, std::span<const SignalPixel> pixels) noexcept {
    const GladGLContext& gl = context_->gl();
    gl.BindTexture(GL_TEXTURE_2D, canvas().texture().name());
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, first_px, row, static_cast<GLsizei>(pixels.size()), 1, GL_RGBA,
                     GL_UNSIGNED_BYTE, pixels.data());
}

void PagePresenter::put_messages() noexcept {
    const int rows = reserved_rows(display_.output);
    if (rows_are_dirty_) {
        blit(context_->gl(), background_, picture_, {0, 0}, {0, 0}, {geometry_.screen_px.x, rows});
        rows_are_dirty_ = false;
    }
    if (has_colour_table(display_.output))
        put_row(t_lock::colour_table_row, 0, colour_table_row_);
    if (has_psync(display_.output)) {
        const std::array<SignalPixel, 1> outputs{psync::outputs_pixel(outputs_)};
        put_row(psync::row, 0, outputs);
        put_row(psync::row, psync::first_px, psync::pixels_of(static_cast<std::uint8_t>(refreshes_ + 1)));
        outputs_ = 0;
    }
    for (std::optional<Message>& message : messages_) {
        if (message) {
            put_row(message->row, 0, message->pixels);
            rows_are_dirty_ = true;
            message.reset();
        }
    }
}

std::vector<std::byte> PagePresenter::read_canvas() const {
    const PixelFormat format = last_step_ ? last_step_->format() : PixelFormat::rgba8;
    std::vector<std::byte> bytes(bytes_in(geometry_.screen_px, format));
    surface_->read(canvas(), format, bytes);
    return bytes;
}

std::vector<std::byte> PagePresenter::read_page(int page) {
    OVERT_EXPECTS(loaded_ && page >= 0 && page < loaded_->pages);
    // Alone on the background, without marks and the square for a photodiode.
    mark_stimuli({});
    if (patch_ || in_slots_.size() > 1)
        is_stimulus_on_canvas_ = false;
    put_page(in_slots_.front(), page);
    compose();
    put_messages();
    return read_canvas();
}

} // namespace overt
