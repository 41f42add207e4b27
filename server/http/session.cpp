#include "server/http/session.h"

// This is the one unit that knows httplib, which writes answers. Connections are accepted, and requests read
// and checked, by us (listener, wire, head, framed_body), since httplib ends where descriptors run out, takes
// Transfer-Encoding beside Content-Length, waits for ever for dripping clients, and holds ranges and limits
// to other rules than ours.
#define CPPHTTPLIB_USE_POLL  // descriptors beyond FD_SETSIZE
#define CPPHTTPLIB_NO_DEFAULT_USER_AGENT
#include <httplib.h>

#include <algorithm>
#include <optional>
#include <random>

#include "core/base/error.h"
#include "server/http/answer.h"
#include "server/http/framed_body.h"
#include "server/http/head.h"
#include "server/http/wire.h"

namespace coppice {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto linger_time = 2s;
constexpr uint64_t linger_bytes = 64 << 20;
constexpr auto spare_header_time = 1s;  // a connection over the limit has to be quick
constexpr auto longest_answer = 24h;    // the rate ends a slow one before
constexpr size_t send_bytes = 256 << 10;

// What httplib sees of a connection: a request line that it cannot get wrong, and a place to write the answer
// to.
class AnswerStream final : public httplib::Stream {
  public:
    AnswerStream(Wire& wire, int socket, const std::string& method, const HttpLimits& limits)
        : wire_(wire),
          socket_(socket),
          head_((method == "HEAD" ? "HEAD" : "GET") + std::string(" / HTTP/1.1\r\n\r\n")),
          patience_(longest_answer, {limits.bytes_per_second, limits.slow_time}) {}

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
    Patience patience_;
};

bool is_plain_token(std::string_view text) {
    return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
    });
}

// Each connection has an httplib::Server of its own, whose handlers know the request that is being answered.
class Session final : private httplib::Server {
  public:
    Session(Serving& serving, int socket, const std::string& address, bool only_always)
        : serving_(serving),
          socket_(socket),
          address_(address),
          only_always_(only_always),
          requests_left_(only_always ? 1 : serving.limits.requests_per_connection),
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
        std::chrono::milliseconds idle_time =
            only_always_ ? spare_header_time : serving_.limits.header_time;  // it has only just come
        while (one_request(idle_time)) idle_time = serving_.limits.idle_time;
    }

  private:
    bool one_request(std::chrono::milliseconds idle_time) {
        exchange_ = Exchange{};
        response_ = Response{};
        request_ = Request{};
        request_.id = serving_.next_request_id();
        request_.remote_address = address_;
        started_ = Clock::now();
        std::optional<Head> head;
        try {
            head = read_head(idle_time);
        } catch (...) {
            refuse();
            return false;
        }
        return head && answer_request(std::move(*head));
    }

    // None: the client has nothing more to say, or the server has ended the connection.
    std::optional<Head> read_head(std::chrono::milliseconds idle_time) {
        Connections& connections = serving_.connections;
        if (!connections.begin_idle(socket_)) return std::nullopt;
        HttpLimits limits = serving_.limits;
        if (only_always_) limits.header_time = spare_header_time;
        try {
            const std::string bytes = wire_.read_head(limits, idle_time);
            connections.end_idle(socket_);
            if (bytes.empty()) return std::nullopt;
            started_ = Clock::now();
            return parse_head(bytes, limits);
        } catch (const Error&) {
            require(!connections.is_stopping(), ErrorCode::service_draining, "",
                    "the service shuts down and read no more of the request");
            throw;
        }
    }

    bool answer_request(Head head) {
        --requests_left_;
        if (const auto id = head.headers.find("x-request-id"); id && is_plain_token(*id)) request_.id = *id;
        request_.method = std::move(head.method);
        request_.path = std::move(head.path);
        request_.query = std::move(head.query);
        request_.headers = std::move(head.headers);
        request_.client_is_gone = [this] { return wire_.is_gone(); };
        Patience patience(serving_.limits.body_time,
                          {serving_.limits.bytes_per_second, serving_.limits.slow_time});
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
            head.chunked, head.content_length, serving_.limits.body_bytes);
        request_.body = &body;
        body_ = &body;
        keep_alive_ = head.keep_alive;

        AnswerStream stream(wire_, socket_, request_.method, serving_.limits);
        bool closed = false;
        const bool sent =
            process_request(stream, address_, 0, {}, 0, false, closed, nullptr) && stream.flush();
        observe(body.bytes_read());
        body_ = nullptr;
        request_.body = nullptr;
        // Where the answer came before the body was read, what is left of it must never be taken for a
        // request; and after an answer that broke off, another would be taken for its end.
        const bool goes_on = sent && keep_alive_ && body.is_finished();
        if (sent && !goes_on) wire_.linger(linger_time, linger_bytes);
        return goes_on;
    }

    void run(httplib::Response& result) {
        exchange_.route = answer(serving_.router, request_, response_, only_always_);
        // The last answer says that it is one.
        if (!body_->is_finished() || requests_left_ == 0 || serving_.connections.is_stopping()) {
            keep_alive_ = false;
        }
        set_common_headers(response_, request_.id);
        result.status = response_.status;
        for (const auto& [name, value] : response_.headers) result.set_header(name, value);
        if (response_.content && response_.content->bytes > 0) {
            result.set_content_provider(response_.content->bytes, response_.content_type,
                                        [this](size_t offset, size_t length, httplib::DataSink& sink) {
                                            return send(offset, length, sink);
                                        });
        } else if (!response_.content_type.empty()) {
            if (request_.method != "HEAD") exchange_.bytes_out = response_.body.size();
            result.set_content(std::move(response_.body), response_.content_type);
        }
    }

    // The head is out when this is called: where the content fails, all that is left is to break off.
    bool send(uint64_t offset, uint64_t length, httplib::DataSink& sink) {
        try {
            buffer_.resize(send_bytes);
            const auto wanted =
                std::span(buffer_).first(static_cast<size_t>(std::min<uint64_t>(length, send_bytes)));
            const size_t got = response_.content->read(offset, wanted);
            require(got > 0, ErrorCode::storage_failed, "", "the content ends after {} of {} bytes", offset,
                    offset + length);
            const std::string_view bytes = as_text(ByteView(buffer_).first(got));
            exchange_.bytes_out += got;
            return sink.write(bytes.data(), bytes.size());
        } catch (const std::exception& exception) {
            response_.fault = exception.what();
            return false;
        }
    }

    void finish_headers(httplib::Response& result) const {
        result.headers.erase("Keep-Alive");
        result.headers.erase("Connection");
        if (!keep_alive_) result.set_header("Connection", "close");
        // httplib promises ranges of whatever is asked for with HEAD.
        if (!response_.has("Accept-Ranges")) result.headers.erase("Accept-Ranges");
        if (result.status == 204 || result.status == 304) {
            result.headers.erase("Content-Length");
            result.headers.erase("Content-Type");
        }
    }

    // The request could not be read, so nothing after it can be either.
    void refuse() {
        set_problem_of_current_exception(response_, request_.id);
        set_common_headers(response_, request_.id);
        Patience patience(linger_time);
        wire_.write(print_last_answer(response_), patience);
        wire_.flush(patience);
        exchange_.bytes_out = response_.body.size();
        observe(0);
        wire_.linger(linger_time, linger_bytes);
    }

    void observe(uint64_t bytes_in) {
        exchange_.request_id = request_.id;
        exchange_.method = request_.method;
        exchange_.path = request_.path;
        exchange_.remote_address = address_;
        exchange_.job = response_.job;
        exchange_.status = response_.status;
        exchange_.bytes_in = bytes_in;
        exchange_.time = Clock::now() - started_;
        exchange_.fault = response_.fault;
        if (serving_.observe) serving_.observe(exchange_);
    }

    Serving& serving_;
    const int socket_;
    const std::string address_;
    const bool only_always_;
    size_t requests_left_;
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

uint64_t random_number() {
    std::random_device random;
    return (static_cast<uint64_t>(random()) << 32) | random();
}

}  // namespace

Serving::Serving(Router given_router, const HttpLimits& given_limits, Observe given_observe)
    : router(std::move(given_router)),
      limits(given_limits),
      observe(std::move(given_observe)),
      connections(limits),
      process_(random_number()) {}

std::string Serving::next_request_id() {
    return fmt::format("{:016x}{:016x}", process_, requests_++);
}

void serve_connection(Serving& serving, int socket, const std::string& address, bool only_always) {
    Session(serving, socket, address, only_always).serve();
}

std::string print_last_answer(const Response& response) {
    std::string text = fmt::format(
        "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\n", response.status,
        httplib::status_message(response.status), response.content_type, response.body.size());
    for (const auto& [name, value] : response.headers) text += fmt::format("{}: {}\r\n", name, value);
    return text + "\r\n" + response.body;
}

}  // namespace coppice
