#include "parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace vcg_ext {

namespace {
std::atomic<int> wanted_threads{0};

int thread_count()
{
    const int wanted = wanted_threads;
    return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}
} // namespace

void set_threads(int count)
{
    wanted_threads = count;
}

void for_chunks(int count, int chunk, const std::function<void(int, int)>& work)
{
    const int pieces = (count + chunk - 1) / chunk;
    const auto run = [&](int piece) { work(piece * chunk, std::min(count, (piece + 1) * chunk)); };
    const int threads = std::min(thread_count(), pieces);
    if (threads <= 1) {
        for (int piece = 0; piece < pieces; ++piece)
            run(piece);
        return;
    }

    std::vector<std::exception_ptr> failure(pieces);
    std::atomic<int> next{0};
    const auto take_pieces = [&] {
        for (int piece = next++; piece < pieces; piece = next++) {
            try {
                run(piece);
            } catch (...) {
                failure[piece] = std::current_exception();
            }
        }
    };
    std::vector<std::thread> helpers;
    for (int i = 1; i < threads; ++i)
        helpers.emplace_back(take_pieces);
    take_pieces();
    for (std::thread& helper : helpers)
        helper.join();
    for (const std::exception_ptr& error : failure)
        if (error)
            std::rethrow_exception(error);
}

} // namespace vcg_ext
