#include "server/http/server.h"

// This is the one unit that knows httplib. It accepts and writes answers; requests are read and checked by us
// (wire, head, framed_body), since httplib takes Transfer-Encoding beside Content-Length, waits for ever for
// dripping clients, and holds ranges and limits to other rules than ours.
#define CPPHTTPLIB_LISTEN_BACKLOG 1024
#define CPPHTTPLIB_USE_POLL  // descriptors beyond FD_SETSIZE
#define CPPHTTPLIB_NO_DEFAULT_USER_AGENT
#include <httplib.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "server/http/answer.h"
#include "server/http/connections.h"
#include "server/http/framed_body.h"
#include "server/http/head.h"
#include "server/http/wire.h"

namespace coppice {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr size_t spare_threads = 64;  // for connections over the limit, which get a 503, and for health
constexpr auto linger_time = 2s;
constexpr auto spare_header_time = 1s;  // a connection over the limit has to be quick
constexpr auto longest_answer = 24h;    // the rate ends a slow one before
constexpr size_t send_bytes = 256 << 10;

// Threads are made when they are first needed and stay.
class ConnectionThreads final : public httplib::TaskQueue {
  public:
    explicit ConnectionThreads(size_t most) : most_(most) {}

    bool enqueue(std::function<void()> connection) override {
        const std::scoped_lock lock(mutex_);
        if (waiting_.size() >= idle_ && !start_thread()) return false;
        waiting_.push_back(std::move(connection));
        ready_.notify_one();
        return true;
    }

    void shutdown() override {
        {
            const std::scoped_lock lock(mutex_);
            ending_ = true;
        }
        ready_.notify_all();
        for (std::thread& thread : threads_) thread.join();
        threads_.clear();
    }

  private:
    bool start_thread() {
        if (threads_.size() >= most_) return false;
        try {
            threads_.emplace_back([this] { run(); });
            ++idle_;  // it will look for work as soon as it can
            return true;
        } catch (const std::system_error&) {
            return false;
        }
    }

    void run() {
        std::unique_lock lock(mutex_);
        for (;;) {
            ready_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
            if (waiting_.empty()) return;
            const auto connection = std::move(waiting_.front());
            waiting_.pop_front();
            --idle_;
            lock.unlock();
            connection();
            lock.lock();
            ++idle_;
        }
    }

    const size_t most_;
    std::mutex mutex_;
    std::condition_variable ready_;
    std::deque<std::function<void()>> waiting_;
    std::vector<std::thread> threads_;
    size_t idle_ = 0;
    bool ending_ = false;
};

// What httplib sees of a connection: a request line that it cannot get wrong, and a place to write the answer
// to.
class AnswerStream final : public httplib::Stream {
  public:
    AnswerStream(Wire& wire, int socket, const std::string& method)
        : wire_(wire),
          socket_(socket),
          head_((method == "HEAD" ? "HEAD" : "GET") + std::string(" / HTTP/1.1\r\n\r\n")) {}

    bool is_readable() const override { return true; }
    bool is_writable() const override { return true; }
    ssize_t read(char* into, size_t size) override {
        const size_t taken = head_.copy(into, size, read_);
        read_ += taken;
        return static_cast<ssize_t>(taken);
    }
    ssize_t write(const char* bytes, size_t size) override {
        return wire_.write({bytes, size}, patience_) ? static_cast<ssize_t>(size) : -1;
    }
    bool flush() { return wire_.flush(patience_); }
    void get_remote_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
    void get_local_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
    socket_t socket() const override { return socket_; }

  private:
    Wire& wire_;
    int socket_;
    std::string head_;
    size_t read_ = 0;
    Patience patience_{longest_answer, 1000};
};

struct Shared {
    Router router;
    HttpLimits limits;
    std::function<void(const Exchange&)> observe;
    Connections connections;
    std::atomic<uint64_t> next_request{0};
    uint64_t process = 0;  // random: request ids of two processes differ
};

bool is_plain_token(std::string_view text) {
    return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
    });
}

// One connection: its requests, one after the other. Each connection has an httplib::Server of its own, whose
// handlers know the request that is being answered.
class Session final : private httplib::Server {
  public:
    Session(Shared& shared, int socket, std::string address, bool only_always)
        : shared_(shared),
          socket_(socket),
          address_(std::move(address)),
          only_always_(only_always),
          wire_(socket) {
        svr_sock_ = socket;  // httplib ends its answers where this is invalid
        set_pre_routing_handler([this](const httplib::Request&, httplib::Response& result) {
            run(result);
            return HandlerResponse::Handled;
        });
        // httplib's own would send what() to the client; ours comes into play where not even a problem can be
        // made.
        set_exception_handler([](const httplib::Request&, httplib::Response& result,
                                 const std::exception_ptr&) { result.status = 500; });
        set_post_routing_handler(
            [this](const httplib::Request&, httplib::Response& result) { finish_headers(result); });
    }

    void serve() {
        for (size_t requests = 0;
             requests < shared_.limits.requests_per_connection && one_request(requests == 0); ++requests) {
        }
    }

  private:
    bool one_request(bool is_first) {
        exchange_ = Exchange{};
        response_ = Response{};
        request_ = Request{};
        request_.id = fmt::format("{:016x}{:016x}", shared_.process, shared_.next_request++);
        request_.remote_address = address_;
        exchange_.remote_address = address_;
        started_ = Clock::now();
        Head head;
        try {
            if (!shared_.connections.begin_idle(socket_)) return false;
            HttpLimits limits = shared_.limits;
            if (only_always_) limits.header_time = spare_header_time;
            const std::string bytes =
                wire_.read_head(limits, is_first ? limits.header_time : limits.idle_time);
            shared_.connections.end_idle(socket_);
            if (bytes.empty()) return false;
            started_ = Clock::now();
            head = parse_head(bytes, limits);
        } catch (...) {
            refuse();
            return false;
        }
        return answer_request(std::move(head));
    }

    bool answer_request(Head head) {
        if (const auto id = head.headers.find("x-request-id"); id && is_plain_token(*id)) request_.id = *id;
        request_.method = std::move(head.method);
        request_.path = std::move(head.path);
        request_.query = std::move(head.query);
        request_.headers = std::move(head.headers);
        request_.client_is_gone = [this] { return wire_.is_gone(); };
        Patience patience(shared_.limits.body_time, shared_.limits.bytes_per_second);
        bool tell_to_continue = head.expects_continue && head.has_body();
        FramedBody body(
            [&](std::span<std::byte> into) {
                // Only now: a request that is refused by its head alone sends no body at all.
                if (std::exchange(tell_to_continue, false)) {
                    wire_.write("HTTP/1.1 100 Continue\r\n\r\n", patience);
                    wire_.flush(patience);
                }
                return wire_.read(into, patience);
            },
            head.chunked, head.content_length, shared_.limits.body_bytes);
        request_.body = &body;
        body_ = &body;
        keep_alive_ = head.keep_alive && !only_always_;

        AnswerStream stream(wire_, socket_, request_.method);
        bool closed = false;
        const bool sent =
            process_request(stream, address_, 0, {}, 0, false, closed, nullptr) && stream.flush();
        observe(body.bytes_read());
        body_ = nullptr;
        request_.body = nullptr;
        // An answer that came before the body was read: what is left of it must never be taken for a request.
        if (!body.is_finished()) wire_.linger(linger_time);
        return sent && keep_alive_;
    }

    void run(httplib::Response& result) {
        const Answered done = answer(shared_.router, request_, response_, only_always_);
        exchange_.route = done.route;
        exchange_.internal_error = done.internal_error;
        if (!body_->is_finished()) keep_alive_ = false;
        set_common_headers(response_, request_.id);
        result.status = response_.status;
        for (const auto& [name, value] : response_.headers) result.set_header(name, value);
        if (response_.content && response_.content->bytes > 0) {
            exchange_.bytes_out = response_.content->bytes;
            result.set_content_provider(response_.content->bytes, response_.content_type,
                                        [this](size_t offset, size_t length, httplib::DataSink& sink) {
                                            return send(offset, length, sink);
                                        });
        } else if (!response_.content_type.empty()) {
            exchange_.bytes_out = response_.body.size();
            result.set_content(std::move(response_.body), response_.content_type);
        }
    }

    bool send(uint64_t offset, uint64_t length, httplib::DataSink& sink) {
        buffer_.resize(send_bytes);
        const auto wanted =
            std::span(buffer_).first(static_cast<size_t>(std::min<uint64_t>(length, send_bytes)));
        const size_t got = response_.content->read(offset, wanted);
        const std::string_view bytes = as_text(ByteView(buffer_).first(got));
        return got > 0 && sink.write(bytes.data(), bytes.size());
    }

    void finish_headers(httplib::Response& result) const {
        result.headers.erase("Keep-Alive");
        result.headers.erase("Connection");
        if (!keep_alive_) result.set_header("Connection", "close");
        if (result.status == 204 || result.status == 304) {
            result.headers.erase("Content-Length");
            result.headers.erase("Content-Type");
        }
    }

    // The request could not be read, so nothing after it can be either.
    void refuse() {
        exchange_.internal_error = set_problem_of_current_exception(response_, request_.id);
        set_common_headers(response_, request_.id);
        response_.set("Connection", "close");
        std::string text = fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n",
                                       response_.status, httplib::status_message(response_.status),
                                       response_.content_type, response_.body.size());
        for (const auto& [name, value] : response_.headers) text += name + ": " + value + "\r\n";
        Patience patience(linger_time, 0);
        wire_.write(text + "\r\n" + response_.body, patience);
        wire_.flush(patience);
        exchange_.bytes_out = response_.body.size();
        observe(0);
        wire_.linger(linger_time);
    }

    void observe(uint64_t bytes_in) {
        exchange_.request_id = request_.id;
        exchange_.method = request_.method;
        exchange_.path = request_.path;
        exchange_.job = response_.job;
        exchange_.status = response_.status;
        exchange_.bytes_in = bytes_in;
        exchange_.time = Clock::now() - started_;
        if (shared_.observe) shared_.observe(exchange_);
    }

    Shared& shared_;
    int socket_;
    std::string address_;
    bool only_always_;
    Wire wire_;

    // of the request that is being answered
    Request request_;
    Response response_;
    Exchange exchange_;
    FramedBody* body_ = nullptr;
    bool keep_alive_ = true;
    Clock::time_point started_;
    Bytes buffer_;
};

}  // namespace

class HttpServer::Acceptor final : private httplib::Server {
  public:
    Acceptor(Router router, HttpLimits limits, std::function<void(const Exchange&)> observe)
        : shared_{std::move(router), limits, std::move(observe), Connections(limits), {}, {}} {
        std::random_device random;
        shared_.process = (static_cast<uint64_t>(random()) << 32) | random();
        new_task_queue = [limits] { return new ConnectionThreads(limits.connections + spare_threads); };
        // Not SO_REUSEPORT, httplib's default: a second service on the port would silently share it.
        set_socket_options([](socket_t socket) {
            const int yes = 1;
            ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
    }

    int start(const std::string& host, int port) {
        const int bound = port == 0 ? bind_to_any_port(host) : (bind_to_port(host, port) ? port : -1);
        require(bound > 0, ErrorCode::option_invalid, "listen", "cannot listen on {}:{}: {}", host, port,
                std::generic_category().message(errno));
        thread_ = std::thread([this] { listen_after_bind(); });
        return bound;
    }

    void stop(std::chrono::milliseconds grace) {
        if (!thread_.joinable()) return;
        // Not httplib's stop(), which cuts off answers that are being sent.
        ::shutdown(svr_sock_, SHUT_RDWR);
        shared_.connections.stop_idle();
        if (!shared_.connections.wait_until_empty(grace)) shared_.connections.cut_off_all();
        thread_.join();
    }

  private:
    bool process_and_close_socket(socket_t socket) override {
        const int yes = 1;
        ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        std::string address;
        int port = 0;
        httplib::detail::get_remote_ip_and_port(socket, address, port);
        const auto verdict = shared_.connections.open(socket, address);
        try {
            // Over a cap, health is answered still: a busy service is not a dead one.
            Session(shared_, socket, address, verdict != Connections::Verdict::welcome).serve();
        } catch (...) {  // a handler's content failed while it was sent: all that is left is to close
        }
        shared_.connections.close(socket, address);
        ::shutdown(socket, SHUT_RDWR);
        ::close(socket);
        return true;
    }

    Shared shared_;
    std::thread thread_;
};

HttpServer::HttpServer(Router router, HttpLimits limits, std::function<void(const Exchange&)> observe)
    : acceptor_(std::make_unique<Acceptor>(std::move(router), limits, std::move(observe))) {}

HttpServer::~HttpServer() {
    stop(std::chrono::milliseconds(0));
}

int HttpServer::start(const std::string& host, int port) {
    return acceptor_->start(host, port);
}

void HttpServer::stop(std::chrono::milliseconds grace) {
    acceptor_->stop(grace);
}

}  // namespace coppice
