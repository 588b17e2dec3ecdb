"""Client of LTI Advantage services (1EdTech: Names and Role Provisioning Services 2.0, Assignment
and Grade Services 2.0, Security Framework 1.0), without a server. The client needs the extra
``lti`` and has been tested only with a simulated LMS. Read in this order:

- ``settings``: the LMS in the course file; ``keys``: the key pair of this program
- ``service``: an access token for a signed assertion, and bounded requests to one origin
- ``names_and_roles``, ``grade_passback``: the two services
"""
