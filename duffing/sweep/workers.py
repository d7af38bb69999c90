"""Tasks on an executor: a bounded number under way, those of a lost worker again, and nothing left running.

Tried in its place: joblib 1.6 with loky (`Parallel(return_as="generator_unordered")`, two workers, tasks of 0.2 s). A
worker that was killed ended the whole run with TerminatedWorkerError, and neither the task nor another try was to be
had; after Ctrl-C its processes outlived the program by one to two seconds on a busy machine; and it takes no executor,
so that a cluster, threads and a pool of one's own would each need a way beside it. dask alone repeats
lost tasks by itself, but is no dependency of the package, and its futures can lose an interrupt (see `_interrupts`).
"""

import signal
import sys
import threading
import time
import warnings
from collections import Counter, deque
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from contextlib import contextmanager, suppress
from queue import Empty, SimpleQueue

from ..errors import LostWorkerError
from ..oscillator import Duffing

# Tasks handed over and not yet back: two each for a thousand workers, whatever the size of the family.
IN_FLIGHT = 2048
# A task that was alone when its worker died is tried so many times more.
RETRIES = 2


def completed(executor, function, arguments, tasks, grace=0.0):
    """Yield (task, function(*arguments(task))) as the tasks get done, in any order.

    executor : a concurrent.futures executor, or a function without arguments that makes one (then shut down here)
    arguments : called when a task is handed over, so that only tasks under way hold memory; the first of what it
        returns are the parameters (6, n) of the task's members
    tasks : hashable, any number
    grace : seconds in which, after an error, tasks that were nearly done may still come in

    When workers die, what they had is done again: by the executor itself if it can (dask), else by a new one: from the
    function that makes one, or a process pool like the one given. Nobody can say which task killed a pool, so
    suspects go first and in ever smaller groups; the one that kills while alone is tried `RETRIES` times more.

    Raises LostWorkerError for a task that goes on killing its worker, and whatever the function raises. What waits is
    then cancelled; what runs comes to its end. Ctrl-C moreover ends the processes of a pool, which would first do what
    they have been handed.
    """
    tasks, again, lost, deaths = iter(tasks), deque(), [], Counter()
    pending, finished, window, suspects, failure = {}, SimpleQueue(), IN_FLIGHT, 0, None
    pool, owned = _start(executor)
    try:
        with _interrupts(finished) as interrupted:
            while failure is None:
                while not interrupted and not lost and len(pending) < window:
                    task = again.popleft() if again else next(tasks, None)
                    if task is None:
                        break
                    try:
                        future = pool.submit(function, *arguments(task))
                    except BrokenExecutor:
                        lost.append(task)
                        break
                    pending[future] = task
                    future.add_done_callback(finished.put)
                future = _next(finished) if pending else None
                if interrupted:
                    raise KeyboardInterrupt
                if pending:
                    task = pending.pop(future)
                    try:
                        result = future.result()
                    except BrokenExecutor:
                        lost.append(task)
                    except _killed_by_dask() as error:
                        failure = LostWorkerError(_sentence(arguments(task), "several"))
                        failure.__cause__ = error
                    except Exception as error:
                        failure = error
                    else:
                        suspects -= 1
                        window = IN_FLIGHT if suspects <= 0 else window
                        yield task, result
                elif lost:
                    deaths.update(lost if len(lost) == 1 else ())
                    if deaths[lost[0]] > RETRIES:
                        raise LostWorkerError(_sentence(arguments(lost[0]), deaths[lost[0]]))
                    pool, owned = _replaced(pool, owned, executor)
                    again.extendleft(reversed(lost))
                    window, suspects, lost = max(1, len(lost) // 16), len(lost), []
                else:
                    return
        end = time.monotonic() + grace
        while pending and time.monotonic() < end:
            with suppress(Empty):
                future = finished.get(timeout=max(0.0, end - time.monotonic()))
                task = pending.pop(future)
                if not future.cancelled() and future.exception() is None:
                    yield task, future.result()
        raise failure
    except KeyboardInterrupt:
        if isinstance(pool, ProcessPoolExecutor):
            _end_processes(pool)
            pending.clear()  # the pool's own thread is giving them up: to cancel one under its hands is an error there
        raise
    finally:
        _cancel(deque(pending))
        if owned:
            pool.shutdown(wait=False, cancel_futures=True)


def _cancel(futures, patience=0.2):
    """Cancel all; what is left after so many seconds, in the background: dask needs a round trip for each."""
    end = time.monotonic() + patience
    while futures and time.monotonic() < end:
        futures.popleft().cancel()

    def rest():
        with suppress(Exception):  # the client may have been closed meanwhile, which cancels as well
            while futures:
                futures.popleft().cancel()

    if futures:
        threading.Thread(target=rest, daemon=True).start()


def _next(queue):
    # Now and then Python gets to see a signal that the system has delivered to another thread.
    while True:
        try:
            return queue.get(timeout=0.1)
        except Empty:
            continue


@contextmanager
def _interrupts(queue):
    """Ctrl-C is noted in a list, and by a None in the queue, instead of raised: a second one is raised.

    Raised as it comes, it can hit a destructor (dask's futures have one), where Python prints and forgets it.
    """
    noted = []

    def note(number, frame):
        signal.signal(signal.SIGINT, signal.default_int_handler)
        noted.append(number)
        queue.put(None)

    main = threading.current_thread() is threading.main_thread()
    if not main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield noted  # signals are somebody else's
        return
    signal.signal(signal.SIGINT, note)
    try:
        yield noted
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def is_executor(value):
    """Whether `completed` takes it: an executor, or something that makes one."""
    return hasattr(value, "submit") or callable(value)


def _start(source):
    """(executor, whether it is ours to shut down)."""
    made = isinstance(source, type) or not hasattr(source, "submit")
    return (source(), True) if made else (source, False)


def _replaced(pool, owned, source):
    if owned:
        pool.shutdown(wait=False)
    if isinstance(source, type) or not hasattr(source, "submit"):
        return source(), True
    if type(source) is not ProcessPoolExecutor:
        raise LostWorkerError(
            f"the workers of executor = {source!r} died, and it takes no more tasks: give a function that makes one"
        )
    warnings.warn(f"workers of executor = {source!r} died: the run goes on with new ones", RuntimeWarning, stacklevel=2)
    # A pool does not tell what it was made from; these have been its names since Python 3.8.
    settings = {name: getattr(source, f"_{name}") for name in ("mp_context", "initializer", "initargs")}
    return ProcessPoolExecutor(source._max_workers, **settings), True


def _end_processes(pool):
    # As ProcessPoolExecutor.terminate_workers does from Python 3.14 on.
    for process in list((pool._processes or {}).values()):
        process.terminate()


def _sentence(arguments, times):
    columns = arguments[0]
    first = Duffing(*columns).named()
    return f"workers died {times} times while they computed {columns.shape[1]} members, the first with {first}"


def _killed_by_dask():
    """dask's error for a task that its scheduler has given up; nothing to catch where dask is not in use."""
    return getattr(sys.modules.get("distributed"), "KilledWorker", ())
