"""What the lecturer's page may do: show a slide, ask, count, end. Each request says it is there."""

from tornado.web import HTTPError

from slamlab.listening.guard import Guarded


class Control(Guarded):
    """A request of the lecturer's page; what is wrong with it is said in words."""

    def initialize(self, lecture, door):
        self._lecture, self._door = lecture, door

    def prepare(self):
        super().prepare()
        if self.client is not None:
            self._lecture.hear()

    def said(self, **kinds):
        """Values of the object that was sent; 400 unless each is of its kind."""
        body = self.body()
        values = [body.get(name) for name in kinds]
        for value, kind in zip(values, kinds.values(), strict=True):
            if not isinstance(value, kind) or isinstance(value, bool):
                raise HTTPError(400)
        return values

    async def told(self, deed, *given):
        """Do something and answer how many phones there are; 409 with the reason if it fails."""
        try:
            deed(*given)
        except ValueError as error:
            self.set_status(409)
            await self.give({"error": str(error)})
        else:
            await self.give({"phones": self._door.clients})

    def need_poll(self):
        """409 unless there is a poll."""
        if self._lecture.poll is None:
            raise HTTPError(409)
        return self._lecture.poll


class Alive(Control):
    async def get(self):
        await self.give({"phones": self._door.clients})


class TheSlide(Control):
    async def put(self):
        number, place, html = self.said(slide=int, place=int, html=str)
        if not (0 <= number <= 999 and 0 <= place <= 999):
            raise HTTPError(400)
        await self.told(self._lecture.show, number, place, html)


class ThePoll(Control):
    async def get(self):
        poll = self.need_poll()
        told = {"phones": self._door.clients, "question": poll.question, "open": poll.is_open}
        await self.give(told | poll.counts())

    async def put(self):
        question, text, choices, unit = self.said(
            question=str, text=str, choices=list | None, unit=str
        )
        if not all(isinstance(choice, str) for choice in choices or ()):
            raise HTTPError(400)
        await self.told(self._lecture.ask, question, text, choices, unit[:40])

    async def delete(self):
        await self.told(self._lecture.drop_poll)


class Close(Control):
    async def post(self):
        self.need_poll()
        await self.told(self._lecture.close_poll)


class Hands(Control):
    async def put(self):
        self.need_poll()
        (hands,) = self.said(hands=list)
        await self.told(self._lecture.raise_hands, hands)


class End(Control):
    async def post(self):
        await self.told(self._lecture.end)


def routes(lecture, door):
    """The control's whole table of routes.

    Parameters
    ----------
    lecture : Lecture
    door : Door of the phones, for their number

    Returns
    -------
    list of tornado's routes
    """
    table = {"/alive": Alive, "/slide": TheSlide, "/poll": ThePoll, "/poll/close": Close}
    table |= {"/hands": Hands, "/end": End}
    return [(path, route, {"lecture": lecture, "door": door}) for path, route in table.items()]
