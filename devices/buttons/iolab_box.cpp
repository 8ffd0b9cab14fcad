#include "devices/buttons/iolab_box.h"

#include <fmt/format.h>

#include "devices/buttons/button_box_device.h"
#include "devices/buttons/hid_box_search.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

using namespace std::chrono_literals;

constexpr SessionDuration iolab_patience = 500ms, iolab_exchange = 30ms;
constexpr int iolab_exchanges = 3;

} // namespace

std::optional<IolabReport> parse_iolab(std::span<const std::byte> report) noexcept {
    if (report.size() < 8)
        return std::nullopt;
    const auto byte = [&](std::size_t i) { return std::to_integer<std::uint32_t>(report[i]); };
    IolabReport told;
    told.ms = byte(4) << 24 | byte(5) << 16 | byte(6) << 8 | byte(7);
    switch (static_cast<char>(byte(0))) {
    case 'D':
    case 'U':
        told.kind = byte(0) == 'D' ? IolabReport::Kind::key_down : IolabReport::Kind::key_up;
        told.button = static_cast<int>(byte(3)) + 1;
        break;
    case 'T':
        told.kind = IolabReport::Kind::clock;
        break;
    case 'Y':
        told.kind = IolabReport::Kind::version;
        break;
    case 'E':
        told.kind = IolabReport::Kind::error;
        break;
    default:
        break;
    }
    return told;
}

std::array<std::byte, 9> iolab_command(char command, std::initializer_list<int> bytes) noexcept {
    std::array<std::byte, 9> report{std::byte{0}, static_cast<std::byte>(command)};
    std::size_t at = 2;
    for (const int byte : bytes)
        if (at < report.size())
            report[at++] = static_cast<std::byte>(byte);
    return report;
}

IolabBox::IolabBox(std::unique_ptr<HidLine> line, Clock& clock) : line_(std::move(line)), clock_(&clock) {
    send(iolab_command('Y'));
    if (!answer(IolabReport::Kind::version, clock_->now() + iolab_patience))
        throw DeviceError(fmt::format("{} does not answer as an ioLab button box does.", line_->name()));
    send(iolab_command('W', {0, 0, 0}));
    send(iolab_command('H', {30'000 >> 8, 30'000 & 0xFF}));
    send(iolab_command('J', {0, 20, 5, 20, 5, 20, 5}));
    send(iolab_command('M', {0, 0x0C, 0xFF}));
    send(iolab_command('R'));
    send(iolab_command('Q'));
    read_clocks();
}

void IolabBox::send(std::array<std::byte, 9> report) {
    if (!line_->write(report))
        throw DeviceError(
            fmt::format("The ioLab button box {} takes no commands: is it still plugged in?", line_->name()));
}

std::optional<IolabReport> IolabBox::answer(IolabReport::Kind kind, SessionTime deadline) {
    std::array<std::byte, 64> report;
    do {
        const std::size_t count = line_->read(report, deadline);
        if (const auto told = parse_iolab(std::span(report).first(count)); told && told->kind == kind)
            return told;
    } while (clock_->now() < deadline && !line_->lost());
    return std::nullopt;
}

void IolabBox::read_clocks() {
    bool answered = false;
    for (int i = 0; i < iolab_exchanges; ++i) {
        const SessionTime before = clock_->now();
        send(iolab_command('T'));
        if (const auto told = answer(IolabReport::Kind::clock, before + iolab_exchange)) {
            times_.add_exchange(before, told->ms, clock_->now());
            answered = true;
        }
    }
    if (!answered)
        throw DeviceError(fmt::format("The ioLab button box {} does not tell its time.", line_->name()));
}

ButtonBoxDescription IolabBox::description() const { return {"iolab", line_->name(), true}; }

void IolabBox::begin() {
    read_clocks();
    std::array<std::byte, 64> stale;
    read_away(*line_, stale, *clock_);
    looked_ = clock_->now();
}

std::size_t IolabBox::poll(std::span<ButtonChange> into) noexcept {
    std::size_t taken = 0;
    std::array<std::byte, 64> report;
    const SessionTime now = clock_->now();
    while (taken < into.size()) {
        const std::size_t count = line_->read(report, now);
        if (count == 0)
            break;
        const auto told = parse_iolab(std::span(report).first(count));
        if (told && (told->kind == IolabReport::Kind::key_down || told->kind == IolabReport::Kind::key_up))
            into[taken++] =
                times_.of(told->button, told->kind == IolabReport::Kind::key_down, told->ms, looked_, now);
    }
    if (taken < into.size())
        looked_ = now;
    return taken;
}

template <> ButtonBoxDevice button_box_device_of<kind_called<ButtonBoxKind>("iolab")>() {
    return {.open = [](const ButtonBoxParts& parts) -> std::unique_ptr<ButtonBox> {
                return std::make_unique<IolabBox>(open_hid(find_hid_box(parts.settings).path, parts.clock),
                                                  parts.clock);
            },
            .look_for = hid_boxes_found};
}

} // namespace overt
