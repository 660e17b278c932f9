-- What a class was given to do, what it handed in, and what came of it.
--
-- `work` is a result by what it was made from: the hash of the files, the assignment, the kit
-- and the grader. `grade` says which work stands for which student's module, and may name work
-- that is not done yet. So equal work is stored once, and a run that was stopped knows the rest.
--
-- `rules`, `assignment`, `submission` and `grade` are what the published grades come from. A run
-- that might change them works on copies of the four (draft.py).

CREATE TABLE about (
    version   INTEGER NOT NULL,
    published INTEGER NOT NULL   -- 1: everything was graded once, and grades.json written
);

CREATE TABLE rules (
    course TEXT NOT NULL,
    policy TEXT NOT NULL         -- the text of the class's course.toml, or nothing
);

CREATE TABLE assignment (
    number   TEXT PRIMARY KEY,
    module   TEXT NOT NULL,
    title    TEXT NOT NULL,
    points   REAL NOT NULL,
    optional INTEGER NOT NULL
);

CREATE TABLE submission (
    id      TEXT PRIMARY KEY,    -- the student's
    problem TEXT
);

CREATE TABLE work (
    key      TEXT PRIMARY KEY,
    final    INTEGER NOT NULL,   -- 0: an internal error, to be tried again
    result   TEXT NOT NULL,      -- JSON, without its pictures
    finished TEXT NOT NULL       -- UTC, to be read by people: nothing is ordered by it
);

CREATE TABLE picture (
    key   TEXT NOT NULL REFERENCES work (key) ON DELETE CASCADE,
    place INTEGER NOT NULL,      -- of its check in the result
    html  BLOB NOT NULL,        -- UTF-8, zlib
    PRIMARY KEY (key, place)
);

CREATE TABLE grade (
    submission TEXT NOT NULL REFERENCES submission (id) ON DELETE CASCADE,
    assignment TEXT NOT NULL REFERENCES assignment (number) ON DELETE CASCADE,
    place      INTEGER NOT NULL, -- among the student's different versions of this module, from 0
    key        TEXT NOT NULL,
    files      TEXT,             -- a hash of what was handed in; NULL in a file of version 1
    handed_in  TEXT,             -- UTC; NULL where it is not known
    PRIMARY KEY (submission, assignment, place)
);

-- Work that is done once more, beside what is published: its result is under key || '#again'.
CREATE TABLE redo (
    key   TEXT PRIMARY KEY,
    shown INTEGER NOT NULL       -- 1: somebody has seen what would change
);

-- What people decided, kept for ever: it names students by their ids, so that a submission may go
-- and come back. The last row that no other withdraws holds for a student and an assignment.
CREATE TABLE decision (
    number     INTEGER PRIMARY KEY,
    student    TEXT NOT NULL,
    assignment TEXT NOT NULL,
    points     REAL,             -- NULL: what another row says is withdrawn
    withdraws  INTEGER REFERENCES decision (number),
    reason     TEXT NOT NULL,
    who        TEXT NOT NULL,
    at         TEXT NOT NULL,    -- UTC, to be read by people
    CHECK ((points IS NULL) = (withdraws IS NOT NULL))
);

CREATE TRIGGER decision_stays BEFORE DELETE ON decision
    BEGIN SELECT RAISE(ABORT, 'a decision is kept for ever'); END;

CREATE TRIGGER decision_is_final BEFORE UPDATE ON decision
    BEGIN SELECT RAISE(ABORT, 'a decision is never changed'); END;
