#pragma once

#include <cstdint>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/light_command_t.hpp>
#include <optional>
#include <string>

#include "common/bus.h"
#include "common/channels.h"
#include "common/event_loop.h"
#include "common/status_reporter.h"
#include "daemons/robot/frame_clock.h"
#include "daemons/robot/latency_record.h"
#include "daemons/robot/robot_core.h"
#include "daemons/robot/robot_messages.h"
#include "daemons/robot/robot_options.h"
#include "lola/socket.h"
#include "messages/command.h"

namespace nao::robot {

/** Connects a RobotCore to LoLA and the bus.
 *
 * For each frame it publishes a sensor state and waits for the joint command that answers it; after
 * 8 ms it answers the frame with the last targets (in lock-step it waits). Without a controller it
 * answers at once. */
class RobotDaemon {
 public:
  /** Bus, loop and model must outlive this. */
  RobotDaemon(Bus& bus, EventLoop& loop, const RobotModel& model, const RobotOptions& options,
              const std::string& robot);
  ~RobotDaemon();
  RobotDaemon(const RobotDaemon&) = delete;
  RobotDaemon& operator=(const RobotDaemon&) = delete;

  /** Makes the robot sit down and go limp; then the loop stops. Without a connection it stops at
   * once. */
  void begin_end();
  /** The robot has become limp, or the connection has ended, after begin_end() or a long press. */
  bool has_ended() const;
  int64_t num_frames() const { return num_frames_; }

 private:
  void subscribe();
  void connect();
  void disconnect();
  void read_frames();
  void begin_frame();
  void finish_frame(const Targets* command);
  void take_joint_command(const naolcm::joint_command_t& message);
  void take_light_command(const naolcm::light_command_t& message);
  void publish(const CommandResult& result);
  void take_status(const naolcm::daemon_status_t& message);
  /** The frame has waited long enough, or its sensor state may have been lost. */
  void handle_deadline();
  void set_deadline(double delay);
  void log_phase();
  void publish_status();

  Bus& bus_;
  EventLoop& loop_;
  const RobotModel& model_;
  RobotOptions options_;
  RobotChannels channels_;
  StatusReporter status_;
  LolaMap map_;
  RobotMessages messages_;
  /** Objects that exist while there is a connection. */
  struct Session {
    Session(UnixSocket socket, const RobotModel& model, const LolaMap& map,
            const RobotOptions& options)
        : connection(std::move(socket)),
          core(model, map, options.starts_itself),
          clock(kLolaPeriod, options.lock_step) {}
    LolaConnection<LolaState> connection;
    RobotCore core;
    FrameClock clock;
    FrameClock::Stamp stamp;
    /** Newest targets from the controller. */
    Targets command;
    /** Whether they came after their frame was answered. */
    bool has_late_command = false;
    /** A frame is not answered yet. */
    bool is_pending = false;
    /** When it came, s, and how long it took to publish it. */
    double frame_time = 0;
    double publish_time = 0;
    Phase logged_phase = Phase::kLimp;
  };
  std::optional<Session> session_;
  LolaState state_;
  LatencyRecord latencies_;
  int deadline_ = -1;
  bool is_ending_ = false;
  /** When the last connection ended, and the gateway reported a driver last, s. */
  double disconnect_time_ = 0;
  double driver_time_ = -1e9;
  int64_t num_frames_ = 0;
};

}  // namespace nao::robot
