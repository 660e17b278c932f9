-- What a class was given to do, what it handed in, and what came of it.
--
-- `work` is a result by what it was made from: the hash of the files, the assignment, the kit
-- and the grader. `grade` says which work stands for which student's module, and may name work
-- that is not done yet. So equal work is stored once, and a run that was stopped knows the rest.

CREATE TABLE about (
    version INTEGER NOT NULL,
    course  TEXT NOT NULL
);

CREATE TABLE assignment (
    number   TEXT PRIMARY KEY,
    module   TEXT NOT NULL,
    title    TEXT NOT NULL,
    points   REAL NOT NULL,
    optional INTEGER NOT NULL
);

CREATE TABLE submission (
    id      TEXT PRIMARY KEY,
    problem TEXT
);

CREATE TABLE work (
    key      TEXT PRIMARY KEY,
    final    INTEGER NOT NULL,   -- 0: an internal error, to be tried again
    result   TEXT NOT NULL,      -- JSON, without its pictures
    finished TEXT NOT NULL       -- UTC
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
    key        TEXT NOT NULL,
    PRIMARY KEY (submission, assignment)
);
