// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>
#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace vcg_ext {

namespace {

std::atomic<int> wanted_threads{0};

/// What OMP_NUM_THREADS asks for, or one per core. The system counts cores by reading files, so it is asked once.
int usual_threads()
{
    static const int count = [] {
        const char* const asked = std::getenv("OMP_NUM_THREADS");
        const int number = asked ? std::atoi(asked) : 0;
        return number > 0 ? number : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    }();
    return count;
}

int thread_count()
{
    const int wanted = wanted_threads;
    return wanted > 0 ? wanted : usual_threads();
}

/// The pieces of one call of for_chunks(), for whoever comes to take some.
class Job {
public:
    /// \param run must live until wait() returns
    Job(int pieces, const std::function<void(int)>& run) : pieces_(pieces), run_(run), failed_(pieces) {}

    /// Does pieces until all are taken. Who comes late does none, and touches nothing of the caller's.
    void help()
    {
        for (int piece = next_++; piece < pieces_; piece = next_++) {
            std::exception_ptr error;
            try {
                run_(piece);
            } catch (...) {
                error = std::current_exception();
            }
            const std::lock_guard<std::mutex> lock(mutex_);
            if (error && piece < failed_) {
                failed_ = piece;
                error_ = error;
            }
            if (++done_ == pieces_)
                all_done_.notify_one();
        }
    }

    /// Waits for the pieces that others took, and throws the first error of the lowest piece.
    void wait()
    {
        std::unique_lock<std::mutex> lock(mutex_);
        all_done_.wait(lock, [this] { return done_ == pieces_; });
        if (error_)
            std::rethrow_exception(std::exchange(error_, nullptr));
    }

private:
    const int pieces_;
    const std::function<void(int)>& run_;
    std::atomic<int> next_{0};
    std::mutex mutex_;
    std::condition_variable all_done_;
    int done_ = 0;
    int failed_;
    std::exception_ptr error_;
};

/// Threads that stay, since starting some for each call costs more than many a call's work.
///
/// They only ever help: a caller does all pieces that nobody else takes, and waits for none but those that are being
/// done. So calls may nest, no thread need come, and none can wait for another in a circle.
class Pool {
public:
    ~Pool()
    {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            ends_ = true;
        }
        offered_.notify_all();
        for (std::thread& thread : threads_)
            thread.join();
    }

    /// Asks for up to `helpers` threads' help.
    void offer(const std::shared_ptr<Job>& job, int helpers)
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        grow(helpers);
        offers_.insert(offers_.end(), std::min<std::size_t>(helpers, threads_.size()), job);
        offered_.notify_all();
    }

    void withdraw(const std::shared_ptr<Job>& job)
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        offers_.erase(std::remove(offers_.begin(), offers_.end(), job), offers_.end());
    }

private:
    void grow(std::size_t threads)
    {
        threads_.reserve(threads);
        while (threads_.size() < threads)
            try {
                threads_.emplace_back([this] { serve(); });
            } catch (const std::system_error&) { // the system has no more: fewer do
                return;
            }
    }

    void serve()
    {
        std::unique_lock<std::mutex> lock(mutex_);
        for (;;) {
            offered_.wait(lock, [this] { return ends_ || !offers_.empty(); });
            if (ends_)
                return;
            const std::shared_ptr<Job> job = std::move(offers_.front());
            offers_.pop_front();
            lock.unlock();
            job->help();
            lock.lock();
        }
    }

    std::mutex mutex_;
    std::condition_variable offered_;
    std::deque<std::shared_ptr<Job>> offers_; ///< a job once for each thread that may still come
    bool ends_ = false;
    std::vector<std::thread> threads_;
};

/// The one pool. It ends with the program, or when its library is unloaded.
class PoolOfAll {
public:
    ~PoolOfAll()
    {
        if (process() == started_by_)
            delete pool_;
        // else a fork: the threads stayed behind, and who joins them waits for ever
    }

    Pool& get() { return *pool_; }

private:
    static long process()
    {
#if __has_include(<unistd.h>)
        return getpid();
#else
        return 0;
#endif
    }

    Pool* pool_ = new Pool;
    long started_by_ = process();
};

Pool& pool()
{
    static PoolOfAll all;
    return all.get();
}

} // namespace

void set_threads(int count)
{
    wanted_threads = count;
}

void for_chunks(int count, int chunk, const std::function<void(int, int)>& work)
{
    const int pieces = chunk_count(count, chunk);
    const std::function<void(int)> run = [&](int piece) {
        const int begin = piece * chunk;
        work(begin, begin + std::min(chunk, count - begin));
    };
    const int threads = std::min(thread_count(), pieces);
    if (threads <= 1) {
        for (int piece = 0; piece < pieces; ++piece)
            run(piece);
        return;
    }
    const auto job = std::make_shared<Job>(pieces, run);
    pool().offer(job, threads - 1);
    job->help();
    pool().withdraw(job);
    job->wait();
}

void for_chunks(int count, int chunk, const Progress& progress, const char* phase,
                const std::function<void(int, int)>& work)
{
    constexpr int steps = 20;
    constexpr int least = 8; // pieces a step, so that all cores have some
    constexpr int most = 64; // so that the next report comes soon
    const int pieces = chunk_count(count, chunk);
    const int step = std::clamp(chunk_count(pieces, steps), least, most);
    for (int first = 0; first < pieces; first += step) {
        report(progress, static_cast<int>(100.0 * first / pieces), phase);
        const int begin = first * chunk;
        const int end = pieces - first > step ? begin + step * chunk : count;
        for_chunks(end - begin, chunk, [&](int from, int to) { work(begin + from, begin + to); });
    }
}

} // namespace vcg_ext
