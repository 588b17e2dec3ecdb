"""Quotas count what the kernel's resource limits do not."""

import os
import threading

from classroom.grading import quotas


def test_too_many_files_exceed_the_quota(tmp_path, monkeypatch):
    monkeypatch.setattr(quotas, "MAX_FILES", 20)
    for i in range(20):
        (tmp_path / f"f{i}").write_text("x")
    assert not quotas.quota_exceeded(os.getpid(), tmp_path)
    (tmp_path / "d").mkdir()
    assert quotas.quota_exceeded(os.getpid(), tmp_path)


def test_bytes_in_any_folder_count_and_holes_in_files_do_not(tmp_path, monkeypatch):
    monkeypatch.setattr(quotas, "MAX_BYTES", 1 << 20)
    with open(tmp_path / "hole", "wb") as file:
        file.truncate(1 << 30)
    assert not quotas.quota_exceeded(os.getpid(), tmp_path)
    (tmp_path / "deep" / "er").mkdir(parents=True)
    (tmp_path / "deep" / "er" / "long").write_bytes(os.urandom(2 << 20))
    assert quotas.quota_exceeded(os.getpid(), tmp_path)


def test_too_many_threads_exceed_the_quota(tmp_path, monkeypatch):
    monkeypatch.setattr(quotas, "MAX_THREADS", threading.active_count() + 50)
    assert not quotas.quota_exceeded(os.getpid(), tmp_path)
    end = threading.Event()
    threads = [threading.Thread(target=end.wait) for _ in range(60)]
    for thread in threads:
        thread.start()
    try:
        assert quotas.quota_exceeded(os.getpid(), tmp_path)
    finally:
        end.set()


def test_an_ended_process_exceeds_the_quota(tmp_path):
    assert quotas.quota_exceeded(2**22 + 1, tmp_path)
