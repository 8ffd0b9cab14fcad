/// Pupil Capture as a session sees it, with sockets of ZeroMQ on this machine and a thread of its own: Pupil
/// Remote, what it publishes, and the annotations that are published to it.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zmq.h>

#include "devices/link/tcp_line.h"

namespace overt::test {

class PupilPeer {
  public:
    /// Its clock is that of the machine and this.
    static constexpr double clock_offset_s = 5000.0;

    std::atomic<bool> answers{true}, publishes{true}, has_surface{true}, calibrates_well{true};
    std::atomic<double> confidence{0.95};
    std::atomic<bool> doubles{false}; ///< each pupil and gaze is told twice, and an older one after it
    std::atomic<int> cameras{2};      ///< 2: both eyes; 0, 1: that camera only
    std::atomic<double> calibration_s{0.1};
    std::atomic<int> gazes_a_picture{1}; ///< as the matching of both eyes makes of them

    PupilPeer() : context_(zmq_ctx_new()) {
        remote_ = bound(ZMQ_REP, remote_port_);
        published_ = bound(ZMQ_PUB, published_port_);
        annotations_ = bound(ZMQ_SUB, annotations_port_);
        zmq_setsockopt(annotations_, ZMQ_SUBSCRIBE, "", 0);
        thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
    }
    ~PupilPeer() {
        thread_ = {};
        for (void* socket : {remote_, published_, annotations_})
            zmq_close(socket);
        zmq_ctx_term(context_);
    }
    PupilPeer(const PupilPeer&) = delete;
    PupilPeer& operator=(const PupilPeer&) = delete;

    /// Instead of the true one, to who asks for the port of what is published.
    void answer_sub_port(const std::string& answer) {
        const std::scoped_lock lock(mutex_);
        sub_port_answer_ = answer;
    }

    NetworkAddress address() const { return {"127.0.0.1", remote_port_}; }

    static double now_s() {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count() +
               clock_offset_s;
    }

    std::vector<std::string> commands() const {
        const std::scoped_lock lock(mutex_);
        return commands_;
    }
    std::vector<nlohmann::json> annotations() const {
        const std::scoped_lock lock(mutex_);
        return told_;
    }
    /// How many gazes were published so far.
    int gazes() const { return gazes_; }

    void publish_raw(const std::string& topic, const std::string& content) {
        const std::scoped_lock lock(mutex_);
        waiting_.emplace_back(topic, content);
    }

  private:
    void* bound(int kind, std::uint16_t& port) {
        void* const socket = zmq_socket(context_, kind);
        const int none = 0;
        zmq_setsockopt(socket, ZMQ_LINGER, &none, sizeof none);
        char endpoint[64];
        std::size_t size = sizeof endpoint;
        if (zmq_bind(socket, "tcp://127.0.0.1:*") != 0 ||
            zmq_getsockopt(socket, ZMQ_LAST_ENDPOINT, endpoint, &size) != 0)
            throw std::runtime_error("no socket of ZeroMQ can be bound");
        const std::string text = endpoint;
        port = static_cast<std::uint16_t>(std::stoi(text.substr(text.rfind(':') + 1)));
        return socket;
    }

    static std::vector<std::string> received(void* socket) {
        std::vector<std::string> frames;
        zmq_msg_t frame;
        do {
            zmq_msg_init(&frame);
            if (zmq_msg_recv(&frame, socket, ZMQ_DONTWAIT) < 0)
                return {};
            frames.emplace_back(static_cast<const char*>(zmq_msg_data(&frame)), zmq_msg_size(&frame));
        } while (zmq_msg_more(&frame) != 0);
        return frames;
    }

    static std::string packed(const nlohmann::json& map) {
        std::string bytes;
        nlohmann::json::to_msgpack(map, bytes);
        return bytes;
    }

    /// One of a time, and more where they are doubled.
    void publish_at(const std::string& topic, nlohmann::json message) {
        publish(topic, packed(message));
        if (!doubles)
            return;
        publish(topic, packed(message));
        message["timestamp"] = message["timestamp"].get<double>() - 0.5;
        publish(topic, packed(message));
    }

    void publish(const std::string& topic, const std::string& content) {
        zmq_send(published_, topic.data(), topic.size(), ZMQ_SNDMORE);
        zmq_send(published_, content.data(), content.size(), 0);
    }

    std::string answer_to(const std::vector<std::string>& frames) {
        const std::string& command = frames.front();
        const std::scoped_lock lock(mutex_);
        commands_.push_back(frames.size() > 1 ? command + " " + nlohmann::json::from_msgpack(frames[1]).dump()
                                              : command);
        if (command == "SUB_PORT")
            return sub_port_answer_.empty() ? std::to_string(published_port_) : sub_port_answer_;
        if (command == "PUB_PORT")
            return std::to_string(annotations_port_);
        if (command == "v")
            return "3.5.1";
        if (command == "t")
            return fmt::format("{}", now_s());
        if (command == "C")
            calibration_ends_s_ = now_s() + calibration_s;
        return "OK";
    }

    void publish_due() {
        if (calibration_ends_s_ > 0.0 && now_s() >= calibration_ends_s_) {
            calibration_ends_s_ = 0.0;
            const std::string subject = calibrates_well ? "calibration.successful" : "calibration.failed";
            publish("notify." + subject, packed({{"subject", subject}}));
            publish("notify.calibration.stopped", packed({{"subject", "calibration.stopped"}}));
        }
        while (publishes && next_s_ <= now_s()) {
            for (const int camera : {0, 1})
                if (cameras == 2 || cameras == camera)
                    publish_at(fmt::format("pupil.{}.3d", camera),
                               {{"topic", fmt::format("pupil.{}.3d", camera)},
                                {"id", camera},
                                {"timestamp", next_s_},
                                {"confidence", confidence.load()},
                                {"norm_pos", {0.5, 0.5}},
                                {"diameter", 40.0},
                                {"diameter_3d", camera == 0 ? 3.5 : 4.5},
                                {"sphere", {{"center", {1.0, 2.0, 40.0}}, {"radius", 10.4}}}});
            for (int i = 0; i < gazes_a_picture; ++i) {
                const double time_s = next_s_ + i / (120.0 * gazes_a_picture);
                publish_at("gaze.3d.01.", {{"topic", "gaze.3d.01."}, {"timestamp", time_s}});
                if (has_surface)
                    publish("surfaces.screen", packed(surface_message(time_s)));
                publish("surfaces.screen2", packed(surface_message(time_s)));
            }
            next_s_ += 1.0 / 120.0;
        }
    }

    nlohmann::json surface_message(double time_s) {
        const std::string topic = cameras == 2 ? "gaze.3d.01." : fmt::format("gaze.3d.{}.", cameras.load());
        ++gazes_;
        return {{"name", "screen"},
                {"surf_to_img_trans", {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
                {"gaze_on_surfaces",
                 {{{"topic", "surfaces.screen_gaze"},
                   {"norm_pos", {0.25, 0.75}},
                   {"on_surf", true},
                   {"confidence", confidence.load()},
                   {"timestamp", time_s},
                   {"base_data", {topic, time_s}}}}},
                {"fixations_on_surfaces", nlohmann::json::array()},
                {"timestamp", time_s}};
    }

    void serve(const std::stop_token& stop) {
        next_s_ = now_s();
        while (!stop.stop_requested()) {
            zmq_pollitem_t items[] = {{remote_, 0, ZMQ_POLLIN, 0}, {annotations_, 0, ZMQ_POLLIN, 0}};
            zmq_poll(items, 2, 1);
            if ((items[0].revents & ZMQ_POLLIN) != 0 && answers) {
                const std::vector<std::string> frames = received(remote_);
                const std::string answer = frames.empty() ? "" : answer_to(frames);
                zmq_send(remote_, answer.data(), answer.size(), 0);
            }
            if ((items[1].revents & ZMQ_POLLIN) != 0)
                if (const std::vector<std::string> frames = received(annotations_); frames.size() == 2) {
                    const std::scoped_lock lock(mutex_);
                    told_.push_back(nlohmann::json::from_msgpack(frames[1]));
                }
            if (!publishes)
                next_s_ = now_s();
            publish_due();
            const std::scoped_lock lock(mutex_);
            for (const auto& [topic, content] : waiting_)
                publish(topic, content);
            waiting_.clear();
        }
    }

    void* context_;
    void *remote_ = nullptr, *published_ = nullptr, *annotations_ = nullptr;
    std::uint16_t remote_port_ = 0, published_port_ = 0, annotations_port_ = 0;
    mutable std::mutex mutex_;
    std::string sub_port_answer_; ///< empty: the true one
    std::vector<std::string> commands_;
    std::vector<nlohmann::json> told_;
    std::vector<std::pair<std::string, std::string>> waiting_;
    std::atomic<int> gazes_{0};
    double next_s_ = 0.0, calibration_ends_s_ = 0.0;
    std::jthread thread_;
};

} // namespace overt::test
