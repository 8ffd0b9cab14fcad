#include "experiment/record/write/session_writer.h"

#include <chrono>
#include <utility>

#include <sqlite3.h>

#include "experiment/base/error.h"
#include "experiment/record/sql.h"

namespace overt {
namespace {

/// How long rows wait at most before they are committed; the promise to the outside is 250 ms.
constexpr std::chrono::milliseconds drain_interval{100};

/// What is lost with a row.
LostRows flips_and_samples(const Row& row) noexcept {
    if (std::holds_alternative<SampleRow>(row))
        return {0, 1};
    return {std::holds_alternative<FlipRecord>(row) || std::holds_alternative<SlotFlip>(row) ||
                std::holds_alternative<SteeredFlip>(row) ||
                std::holds_alternative<MissedRefresh>(row),
            0};
}

} // namespace

SessionStore::Writer::Writer(const std::filesystem::path& file, const Options& options)
    : file_(file), wait_when_full_(options.wait_when_full),
      rows_(file, {options.started_utc, options.program_version, options.program_sha256, options.resumption,
                   options.detection, options.options}),
      ring_(options.ring_capacity), thread_([this] { run(); }) {}

void SessionStore::Writer::push(const Row& row) noexcept {
    while (!ring_.try_push(row)) {
        bell_.ring();
        if (!wait_when_full_ && !std::holds_alternative<RowMessage*>(row))
            return count_lost(row);
        ring_.wait_for_room();
    }
    if (ring_.size() > ring_.capacity() / 2)
        bell_.ring();
}

std::future<void> SessionStore::Writer::send(decltype(RowMessage::content) content) {
    throw_failure();
    auto message = std::make_unique<RowMessage>(RowMessage{std::move(content), {}});
    auto written = message->written.get_future();
    push(Row(message.release()));
    return written;
}

void SessionStore::Writer::throw_failure() {
    if (!failed_.load(std::memory_order_acquire))
        return;
    const std::lock_guard lock(failure_mutex_);
    std::rethrow_exception(failure_);
}

void SessionStore::Writer::run() {
    for (bool last = false; !last;) {
        bell_.wait_for(drain_interval);
        last = stopping_.load(std::memory_order_acquire); // read first: what was pushed before it is drained
        drain();
    }
}

void SessionStore::Writer::drain() {
    constexpr std::size_t rows_between_announcements = 4096;
    // Only what is there now: a busy session must not keep the transaction open.
    const std::size_t waiting = ring_.size();
    Row row;
    for (std::size_t i = 0; i < waiting && ring_.try_pop(row); ++i) {
        handle(row);
        if (i % rows_between_announcements == 0)
            ring_.announce_room();
    }
    ring_.announce_room();
    try {
        rows_.commit();
        uncommitted_ = {};
    } catch (const SQLite::Exception& reason) {
        fail(reason);
    }
}

void SessionStore::Writer::handle(const Row& row) {
    RowMessage* const* const carried = std::get_if<RowMessage*>(&row);
    const std::unique_ptr<RowMessage> message(carried ? *carried : nullptr);
    if (!failed_.load(std::memory_order_relaxed)) {
        try {
            write(row);
        } catch (const SQLite::Exception& reason) {
            fail(reason);
        }
    }
    if (failed_.load(std::memory_order_relaxed)) {
        count_lost(row);
        if (message)
            message->written.set_exception(failure_);
    } else if (message) {
        message->written.set_value();
        if (std::holds_alternative<TrialFinish>(message->content))
            rows_.checkpoint();
    }
}

void SessionStore::Writer::write(const Row& row) {
    std::visit(
        [this]<class Content>(const Content& content) {
            if constexpr (std::is_same_v<Content, RowMessage*>)
                write_message(*content);
            else
                rows_.write(content);
        },
        row);
    uncommitted_ += flips_and_samples(row);
}

void SessionStore::Writer::write_message(const RowMessage& message) {
    std::visit([this](const auto& content) { rows_.write(content); }, message.content);
    if (!std::holds_alternative<TrialFinish>(message.content))
        return;
    uncommitted_ = {};
    // What is written goes on into a file that has no name any more, or another one; inode numbers would tell
    // more, but not on every file system.
    std::error_code error;
    if (!std::filesystem::exists(file_, error) && !error)
        throw SQLite::Exception("the file was moved or deleted while the session ran",
                                SQLITE_READONLY_DBMOVED);
}

void SessionStore::Writer::fail(const SQLite::Exception& reason) {
    rows_.roll_back();
    lost_flips_ += std::exchange(uncommitted_.flips, 0);
    lost_samples_ += std::exchange(uncommitted_.samples, 0);
    const std::lock_guard lock(failure_mutex_);
    try {
        throw_record_error(file_, "writing the session", reason);
    } catch (const RecordError&) {
        failure_ = std::current_exception();
    }
    failed_.store(true, std::memory_order_release);
}

void SessionStore::Writer::count_lost(const Row& row) noexcept {
    const LostRows lost = flips_and_samples(row);
    lost_flips_ += lost.flips;
    lost_samples_ += lost.samples;
}

void SessionStore::Writer::stop() noexcept {
    if (!thread_.joinable())
        return;
    stopping_.store(true, std::memory_order_release);
    bell_.ring();
    thread_.join();
}

void SessionStore::Writer::close() {
    throw_failure();
    try {
        rows_.close();
    } catch (const SQLite::Exception& reason) {
        throw_record_error(file_, "closing the session", reason);
    }
}

} // namespace overt
