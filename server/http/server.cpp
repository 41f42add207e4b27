#include "server/http/server.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <optional>
#include <thread>

#include "core/base/error.h"
#include "server/http/answer.h"
#include "server/http/connection_threads.h"
#include "server/http/listener.h"
#include "server/http/refusals.h"
#include "server/http/session.h"
#include "server/http/turned_away.h"

namespace coppice {
namespace {

using namespace std::chrono_literals;

constexpr size_t spare_threads = 64;  // for connections over the limit, which get a 503, and for health

// A connection, counted as long as it is there.
class Guest {
  public:
    Guest(Connections& connections, Accepted accepted)
        : connections_(connections),
          socket_(std::move(accepted.socket)),
          number_(socket_.number()),
          address_(std::move(accepted.address)),
          verdict_(connections_.open(number_, address_)) {}
    ~Guest() {
        if (verdict_ != Connections::Verdict::too_many_from_address) connections_.close(number_, address_);
    }
    Guest(const Guest&) = delete;
    Guest& operator=(const Guest&) = delete;

    Connections::Verdict verdict() const { return verdict_; }
    int socket() const { return number_; }
    const std::string& address() const { return address_; }
    Descriptor release_socket() { return std::move(socket_); }

  private:
    Connections& connections_;
    Descriptor socket_;
    const int number_;
    const std::string address_;
    const Connections::Verdict verdict_;
};

Problem too_many_from_address(const HttpLimits& limits) {
    return {ErrorCode::quota_exceeded,
            fmt::format("your address has {} connections, the limit (http_connections_per_address); close "
                        "some, or use those that are open for further requests",
                        limits.connections_per_address),
            {}};
}

Problem too_many(const HttpLimits& limits) {
    return {ErrorCode::queue_full,
            fmt::format("the service has more than {} connections, the limit (http_connections); try again "
                        "soon",
                        limits.connections),
            {}};
}

Problem no_thread() {
    return {ErrorCode::queue_full,
            "the system gives the service no more threads to serve connections; try again soon",
            {}};
}

}  // namespace

class HttpServer::Front {
  public:
    Front(Router router, const HttpLimits& limits, Observe observe)
        : serving_(std::move(router), limits, std::move(observe)) {}

    int start(const std::string& host, int port) {
        listener_.emplace(host, port);
        thread_ = std::thread([this] { accept_all(); });
        return listener_->port();
    }

    void stop(std::chrono::milliseconds grace) {
        if (!thread_.joinable()) return;
        listener_->stop();
        serving_.connections.stop_idle();
        if (!serving_.connections.wait_until_empty(grace)) serving_.connections.cut_off_all();
        thread_.join();
        listener_.reset();
    }

  private:
    struct Refused {
        TurnedAway turned_away;
        Refusals told;
    };

    void accept_all() {
        ConnectionThreads threads(serving_.limits.connections + spare_threads);
        Refused refused{{}, Refusals(serving_.observe)};
        while (!listener_->is_stopped()) {
            try {
                auto accepted = listener_->accept(refused.turned_away.empty() ? 1000ms : 50ms);
                if (accepted) take(std::move(*accepted), threads, refused);
                refused.turned_away.tidy();
                refused.told.tell();
            } catch (
                const std::exception&) {  // no memory: this connection ends, and the next may find some again
            }
        }
    }

    // Only an address that has too many connections is refused here, at no cost; over the cap of all, a spare
    // thread looks whether it is health that is asked for: a busy service is not a dead one.
    void take(Accepted accepted, ConnectionThreads& threads, Refused& refused) {
        const int yes = 1;
        ::setsockopt(accepted.socket.number(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        const auto guest = std::make_shared<Guest>(serving_.connections, std::move(accepted));
        if (guest->verdict() == Connections::Verdict::too_many_from_address) {
            turn_away(*guest, too_many_from_address(serving_.limits), refused);
            return;
        }
        using Outcome = ConnectionThreads::Outcome;
        const Outcome outcome = threads.run([this, guest] { serve(*guest); });
        if (outcome == Outcome::all_busy) turn_away(*guest, too_many(serving_.limits), refused);
        if (outcome == Outcome::no_thread)
            turn_away(*guest, no_thread(), refused, "there are no more threads");
    }

    void serve(const Guest& guest) {
        try {
            serve_connection(serving_, guest.socket(), guest.address(),
                             guest.verdict() != Connections::Verdict::welcome);
        } catch (...) {  // out of memory even for an answer: all that is left is to close
        }
    }

    // fault: for the log, where it is the machine's and not the clients'.
    void turn_away(Guest& guest, const Problem& problem, Refused& refused, const char* fault = "") {
        Response response;
        Exchange exchange;
        exchange.request_id = serving_.next_request_id();
        exchange.remote_address = guest.address();
        set_problem(response, problem);
        set_common_headers(response, exchange.request_id);
        exchange.status = response.status;
        exchange.bytes_out = response.body.size();
        exchange.fault = fault;
        refused.turned_away.turn_away(guest.release_socket(), print_last_answer(response));
        refused.told.add(std::move(exchange));
    }

    Serving serving_;
    std::optional<Listener> listener_;
    std::thread thread_;
};

HttpServer::HttpServer(Router router, const HttpLimits& limits, Observe observe)
    : front_(std::make_unique<Front>(std::move(router), limits, std::move(observe))) {}

HttpServer::~HttpServer() {
    stop(std::chrono::milliseconds(0));
}

int HttpServer::start(const std::string& host, int port) {
    return front_->start(host, port);
}

void HttpServer::stop(std::chrono::milliseconds grace) {
    front_->stop(grace);
}

}  // namespace coppice
