#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <algorithm>
#include <array>
#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/associated_executor.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>

namespace nao {

/** A completion handler of any type: called once with the result and the number of bytes. */
class Completion {
 public:
  using executor_type = boost::asio::any_io_executor;

  /** @param handler  Takes (error_code, size_t) or (error_code). @param executor  Where it is
   * called unless it names an executor itself. */
  template <class Handler>
  Completion(Handler&& handler, const executor_type& executor)
      : executor_(boost::asio::get_associated_executor(handler, executor)),
        target_(std::make_unique<Target<std::decay_t<Handler>>>(std::forward<Handler>(handler))) {}

  void operator()(const boost::system::error_code& error, size_t num_bytes = 0) {
    // The handler may start the next operation, and destroy this object.
    const std::unique_ptr<TargetBase> target = std::move(target_);
    target->call(error, num_bytes);
  }
  executor_type get_executor() const { return executor_; }

 private:
  struct TargetBase {
    virtual ~TargetBase() = default;
    virtual void call(const boost::system::error_code& error, size_t num_bytes) = 0;
  };
  template <class Handler>
  struct Target : TargetBase {
    explicit Target(Handler source) : handler(std::move(source)) {}
    void call(const boost::system::error_code& error, size_t num_bytes) override {
      // Moved out first: the memory of an operation is released before its handler is called.
      Handler last = std::move(handler);
      if constexpr (std::is_invocable_v<Handler&, boost::system::error_code, size_t>) {
        last(error, num_bytes);
      } else {
        last(error);
      }
    }
    Handler handler;
  };

  executor_type executor_;
  std::unique_ptr<TargetBase> target_;
};

/** Up to 16 buffers of one operation; an operation on more transfers the first 16. */
template <class Buffer>
class BufferList {
 public:
  using value_type = Buffer;
  using const_iterator = const Buffer*;

  template <class Sequence>
  explicit BufferList(const Sequence& buffers) {
    auto buffer = boost::asio::buffer_sequence_begin(buffers);
    const auto last = boost::asio::buffer_sequence_end(buffers);
    for (; buffer != last && size_ < buffers_.size(); ++buffer) buffers_[size_++] = Buffer(*buffer);
  }
  const_iterator begin() const { return buffers_.data(); }
  const_iterator end() const { return buffers_.data() + size_; }
  /** Removes bytes from the beginning. */
  void consume(size_t num_bytes) {
    for (size_t i = 0; i < size_; ++i) {
      const size_t of_buffer = std::min(num_bytes, buffers_[i].size());
      buffers_[i] += of_buffer;
      num_bytes -= of_buffer;
    }
  }

 private:
  std::array<Buffer, 16> buffers_;
  size_t size_ = 0;
};

/** A TCP stream with or without TLS, as one type.
 *
 * HTTP and WebSocket of Boost.Beast are templates of their stream: with one type they are compiled
 * once, and TCP and TLS are compiled for one type of handler, here. */
class WebStream {
 public:
  using executor_type = boost::beast::tcp_stream::executor_type;
  using next_layer_type = boost::beast::tcp_stream;

  explicit WebStream(boost::beast::tcp_stream stream);
  /** With TLS: handshake() comes first. */
  WebStream(boost::beast::tcp_stream stream, boost::asio::ssl::context& tls);
  ~WebStream();
  WebStream(WebStream&&) noexcept;
  WebStream& operator=(WebStream&&) noexcept;

  bool is_secure() const { return secure_ != nullptr; }
  executor_type get_executor() { return next_layer().get_executor(); }
  /** The TCP stream. */
  next_layer_type& next_layer();
  const next_layer_type& next_layer() const;

  /** The TLS handshake of a server. @param received  Bytes of it that have been read already; the
   * handler's second argument is how many of them it took. */
  void handshake(boost::asio::const_buffer received, Completion completion);

  /** The TLS handshake of a client, which does not check the server's certificate. @param host  Of
   * the server, sent to it (RFC 6066, section 3). */
  void connect(const std::string& host, Completion completion);

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    read_some(BufferList<boost::asio::mutable_buffer>(buffers),
              erase(std::forward<Handler>(handler)));
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    write_some(BufferList<boost::asio::const_buffer>(buffers),
               erase(std::forward<Handler>(handler)));
  }

  enum class Written { kNothing, kPart, kAll };
  /** Writes whole frames at once, past the layers above. What they write meanwhile comes after it.
   * @param handler  Called when the rest is written, if that was a part; the bytes must live until
   *   then.
   * @return kNothing: with TLS, during a write of the layers above, or if the socket takes nothing.
   */
  template <class Buffers, class Handler>
  Written write_now(const Buffers& buffers, Handler&& handler) {
    BufferList<boost::asio::const_buffer> rest(buffers);
    const size_t size = boost::asio::buffer_size(buffers);
    const size_t written = write_at_once(rest);
    if (written == 0) return Written::kNothing;
    if (written == size) return Written::kAll;
    rest.consume(written);
    write_rest(rest, erase(std::forward<Handler>(handler)));
    return Written::kPart;
  }

  /** Ends a WebSocket's connection in the way of its stream; found by Boost.Beast. */
  template <class Handler>
  friend void async_teardown(boost::beast::role_type role, WebStream& stream, Handler&& handler) {
    stream.tear_down(role, stream.erase(std::forward<Handler>(handler)));
  }

 private:
  struct Secure;

  template <class Handler>
  Completion erase(Handler&& handler) {
    return Completion(std::forward<Handler>(handler), get_executor());
  }
  void read_some(const BufferList<boost::asio::mutable_buffer>& buffers, Completion completion);
  void write_some(const BufferList<boost::asio::const_buffer>& buffers, Completion completion);
  size_t write_at_once(const BufferList<boost::asio::const_buffer>& buffers);
  void write_rest(const BufferList<boost::asio::const_buffer>& rest, Completion completion);
  void tear_down(boost::beast::role_type role, Completion completion);

  /** Exactly one of them. */
  std::unique_ptr<boost::beast::tcp_stream> plain_;
  std::unique_ptr<Secure> secure_;
  /** Of the layers above. */
  bool is_writing_ = false;
  /** That of write_rest(), and what the layers above write after it. */
  bool is_writing_rest_ = false;
  std::function<void()> waiting_write_;
};

}  // namespace nao
