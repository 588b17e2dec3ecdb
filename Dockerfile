# Image of a student's server for JupyterHub (DockerSpawner, Zero to JupyterHub); see docs/server.md.
# The first stage has the solutions, the second one only the students' pack and its environment.
FROM python:3.12-slim-bookworm AS build
# hadolint ignore=DL3008
RUN apt-get update \
    && apt-get install --no-install-recommends -y make \
    && rm -rf /var/lib/apt/lists/*
WORKDIR /build
COPY . .
RUN make hub-env HUB=/opt/slam-course PYTHON=python3

FROM python:3.12-slim-bookworm
RUN useradd --create-home --uid 1000 student
# owned by root, so that students cannot change it
COPY --from=build /opt/slam-course /opt/slam-course
ENV PATH=/opt/slam-course/env/bin:$PATH OPENBLAS_NUM_THREADS=1
USER 1000
WORKDIR /home/student
EXPOSE 8888
CMD ["python", "-m", "classroom.hub.student_server"]
